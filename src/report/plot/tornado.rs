//! Tornado charts: sensitivity of a result to several inputs. Bars show increases and decreases from the base case.

use super::{Axis, Frame, LETTER, escape, short, text};

/// Height of a bar with the space around it [px].
const BAR: f64 = 19.0;
/// Space between the bar groups of two inputs [px].
const GAP: f64 = 7.0;

/// An input parameter of a tornado chart, with its tested values.
#[derive(Debug, Clone, Default)]
pub struct TornadoInput {
    /// Name of the input.
    pub name: String,
    /// Label of each tested value, and the change of the result; changes that are not finite are left out.
    pub values: Vec<(String, f64)>,
}

/// A tornado chart: one group of bars per input, the most influential input on top.
#[derive(Debug, Clone, Default)]
pub struct TornadoChart {
    /// Title of the chart for screen readers; the title is not drawn.
    pub title: String,
    /// Label of the horizontal axis: quantity and unit of the change.
    pub x_label: String,
    /// The inputs, in any order.
    pub levers: Vec<TornadoInput>,
    /// Width of the chart [px]. The height follows from the number of bars.
    pub width: f64,
}

impl TornadoChart {
    /// Returns the chart as an `<svg>` element.
    pub fn svg(&self) -> String {
        let largest_change =
            |lever: &TornadoInput| lever.values.iter().map(|(_, change)| change.abs()).fold(0.0, f64::max);
        let mut levers: Vec<&TornadoInput> = self.levers.iter().collect();
        // The sort is stable: inputs of equal influence keep their order.
        levers.sort_by(|a, b| largest_change(b).total_cmp(&largest_change(a)));
        let text_width = |words: &str| LETTER * words.chars().count() as f64;
        let name_width = levers.iter().map(|lever| text_width(&lever.name)).fold(0.0, f64::max);
        let rows: usize = levers.iter().map(|lever| lever.values.len()).sum();
        let height = 14.0 + BAR * rows as f64 + GAP * levers.len() as f64 + 42.0;
        let mut frame = Frame::new([self.width, height], &[], &[]);
        frame.left = name_width + 24.0;
        let bars =
            levers.iter().flat_map(|lever| &lever.values).map(|(words, change)| (text_width(words) + 12.0, *change));
        let axis = self.axis(frame.right - frame.left, &bars.collect::<Vec<_>>());

        let mut svg = frame.open(&self.title);
        let zero = frame.x(&axis, 0.0);
        svg += &format!("<path class=\"zero\" d=\"M{zero:.1} {:.1}V{:.1}\"/>", frame.top, frame.bottom);
        let mut y = frame.top + 0.5 * GAP;
        for lever in levers {
            let middle = y + 0.5 * BAR * lever.values.len() as f64;
            svg += &text(frame.left - 8.0, middle + 4.0, "label end", &lever.name);
            for (words, change) in &lever.values {
                if change.is_finite() {
                    svg += &bar(zero, y, frame.x(&axis, *change) - zero, &lever.name, words, *change);
                }
                y += BAR;
            }
            y += GAP;
        }
        svg += &frame.horizontal_axis(&axis);
        svg + "</svg>\n"
    }

    /// Creates an axis of a length [px] with space for the labels at the ends of the bars. `bars` lists the label width
    /// [px] and the change of each bar. The labels have a fixed width in pixels; the bars get the remaining length.
    fn axis(&self, length: f64, bars: &[(f64, f64)]) -> Axis {
        let largest = |quantity: &dyn Fn(&(f64, f64)) -> f64| bars.iter().map(quantity).fold(0.0, f64::max);
        let (below, above) = (largest(&|(_, change)| -change), largest(&|(_, change)| *change));
        let range = if below + above > 0.0 { below + above } else { 1.0 };
        let left = largest(&|(words, change)| if *change < 0.0 { *words } else { 0.0 });
        let right = largest(&|(words, change)| if *change < 0.0 { 0.0 } else { *words });
        // The bars always get at least one third of the axis length, even if the labels are long.
        let scale = (length - left - right).max(length / 3.0) / range;
        Axis::tight(&self.x_label, [-below - left / scale, above + right / scale], (length / 90.0) as usize)
    }
}

/// Draws a bar from zero with its label at the end.
fn bar(zero: f64, y: f64, pixels: f64, name: &str, words: &str, change: f64) -> String {
    let (left, class) = if pixels < 0.0 { (zero + pixels, "note end") } else { (zero, "note") };
    let end = zero + pixels + if pixels < 0.0 { -5.0 } else { 5.0 };
    let colour = usize::from(pixels >= 0.0);
    format!(
        "<rect class=\"bar c{colour}\" x=\"{left:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"><title>{} {}: {}</title></rect>",
        y + 2.0,
        pixels.abs().max(1.0),
        BAR - 4.0,
        escape(name),
        escape(words),
        short(change, 2)
    ) + &text(end, y + 0.5 * BAR + 4.0, class, words)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(levers: &[(&str, &[(&str, f64)])]) -> TornadoChart {
        let lever = |(name, values): &(&str, &[(&str, f64)])| TornadoInput {
            name: (*name).to_owned(),
            values: values.iter().map(|(words, change)| ((*words).to_owned(), *change)).collect(),
        };
        TornadoChart { levers: levers.iter().map(lever).collect(), width: 800.0, ..TornadoChart::default() }
    }

    /// Left and right edges of the bars [px], from the top bar to the bottom bar.
    fn edges(svg: &str) -> Vec<[f64; 2]> {
        let number = |rest: &str, name: &str| -> f64 {
            let after = rest.split_once(&format!(" {name}=\"")).unwrap().1;
            after.split_once('"').unwrap().0.parse().unwrap()
        };
        svg.split("<rect ").skip(1).map(|rest| [number(rest, "x"), number(rest, "x") + number(rest, "width")]).collect()
    }

    #[test]
    fn the_largest_change_is_on_top_and_bars_are_to_scale() {
        let svg = chart(&[("small", &[("1", 2.0)]), ("large", &[("low", -8.0), ("high", 4.0)])]).svg();
        let [low, high, small] = edges(&svg)[..] else { panic!("{svg}") };
        assert!(svg.find(">large<").unwrap() < svg.find(">small<").unwrap());
        let zero = low[1];
        // Coordinates are rounded to a tenth of a pixel.
        assert!((high[0] - zero).abs() < 0.2 && (small[0] - zero).abs() < 0.2);
        assert!(((zero - low[0]) / (high[1] - zero) - 2.0).abs() < 0.01, "{svg}");
        assert!(((high[1] - zero) / (small[1] - zero) - 2.0).abs() < 0.01, "{svg}");
    }

    #[test]
    fn labels_stay_inside_the_chart() {
        let long = "[35.5,41.0] instead";
        let svg = chart(&[("key", &[(long, -3.0), (long, 1.0)])]).svg();
        let [low, high] = edges(&svg)[..] else { panic!("{svg}") };
        let words = LETTER * long.len() as f64 + 5.0;
        assert!(low[0] - words > 0.0 && high[1] + words < 800.0, "{svg}");
    }

    #[test]
    fn a_chart_without_changes_is_valid() {
        for chart in [chart(&[]), chart(&[("key", &[("a", 0.0), ("b", f64::NAN)])])] {
            assert!(!chart.svg().contains("NaN") && chart.svg().ends_with("</svg>\n"));
        }
    }
}
