//! Bar charts.

use super::{Axis, Frame, LETTER, escape, marks, short, text};

/// A series of a bar chart, with one bar per group.
#[derive(Debug, Clone, Default)]
pub struct Bars {
    /// Name in the legend; if it is empty, the legend has no entry.
    pub name: String,
    /// Heights of the bars; values that are not finite have no bar.
    pub values: Vec<f64>,
    /// Index in the colour palette.
    pub colour: usize,
    /// True for outlined, pale bars, which distinguish measurements from simulations.
    pub hollow: bool,
}

/// A bar chart.
#[derive(Debug, Clone, Default)]
pub struct BarChart {
    /// Title of the chart for screen readers; the title is not drawn.
    pub title: String,
    /// Label of the horizontal axis: what the groups are.
    pub x_label: String,
    /// Label of the vertical axis: quantity and unit.
    pub y_label: String,
    /// Names of the groups.
    pub groups: Vec<String>,
    /// The series of the chart.
    pub bars: Vec<Bars>,
    /// True if the bars of all series in a group are drawn at the same position. Each group should then have only one
    /// finite value.
    pub stacked: bool,
    /// Horizontal lines: value and label.
    pub marks: Vec<(f64, String)>,
    /// Width and height of the chart [px].
    pub size: [f64; 2],
}

impl BarChart {
    /// Returns the chart as an `<svg>` element.
    pub fn svg(&self) -> String {
        let height = self.size[1];
        let named =
            || self.bars.iter().filter(|bars| !bars.name.is_empty() && bars.values.iter().any(|v| v.is_finite()));
        let names: Vec<&str> = named().map(|bars| bars.name.as_str()).collect();
        let frame = Frame::new(self.size, &names, &self.marks);
        let values = self.bars.iter().flat_map(|bars| bars.values.iter().copied());
        let values = values.chain(self.marks.iter().map(|m| m.0)).chain([0.0]);
        let y = Axis::round(&self.y_label, values, (height / 55.0) as usize);

        let mut svg = frame.open(&self.title);
        svg += &frame.vertical_axis(&y);
        let pitch = (frame.right - frame.left) / self.groups.len().max(1) as f64;
        let slots = if self.stacked { 1 } else { self.bars.len().max(1) };
        let bar_width = (0.76 * pitch / slots as f64).min(34.0);
        let every = self.named_groups(pitch);
        for (group, name) in self.groups.iter().enumerate() {
            let middle = frame.left + pitch * (group as f64 + 0.5);
            let first = middle - 0.5 * bar_width * slots as f64;
            for (index, bars) in self.bars.iter().enumerate() {
                let Some(value) = bars.values.get(group).copied().filter(|v| v.is_finite()) else { continue };
                let (top, foot) = (frame.y(&y, value.max(0.0)), frame.y(&y, value.min(0.0)));
                let left = first + bar_width * (index % slots) as f64;
                let series = if bars.name.is_empty() { &self.y_label } else { &bars.name };
                svg += &format!(
                    "<rect class=\"{}\" x=\"{:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\"><title>{}, {}: {}</title></rect>",
                    class(bars),
                    left + 0.06 * bar_width,
                    0.88 * bar_width,
                    foot - top,
                    escape(name),
                    escape(series),
                    short(value, 4)
                );
            }
            if group % every == 0 {
                svg += &text(middle, frame.bottom + 18.0, "tick mid", name);
            }
        }
        svg += &frame.horizontal_label(&self.x_label);
        svg += &marks(&frame, &y, &self.marks);
        let entries: Vec<(String, String)> = named()
            .map(|bars| {
                (
                    bars.name.clone(),
                    format!("<rect class=\"{}\" x=\"6\" y=\"-6\" width=\"13\" height=\"12\"/>", class(bars)),
                )
            })
            .collect();
        svg += &frame.legend(&entries);
        svg + "</svg>\n"
    }

    /// Returns the distance between groups whose names are written, so that the names do not overlap; `pitch` is the
    /// distance between the middles of two groups [px]. The distance is 1, 2 or 5, or ten times such a number, and so on.
    fn named_groups(&self, pitch: f64) -> usize {
        let letters = self.groups.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        let width = LETTER * letters as f64 + NAME_GAP;
        let mut every = [1, 2, 5];
        while every[2] as f64 * pitch < width {
            every = every.map(|number| 10 * number);
        }
        every.into_iter().find(|number| *number as f64 * pitch >= width).unwrap_or(every[2])
    }
}

/// Smallest gap between the names of two groups [px].
const NAME_GAP: f64 = 5.0;

fn class(bars: &Bars) -> String {
    let hollow = if bars.hollow { " hollow" } else { "" };
    format!("bar c{}{hollow}", bars.colour % super::COLOURS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_many_groups_do_not_overlap() {
        let names =
            |count: usize| BarChart { groups: (1..=count).map(|n| n.to_string()).collect(), ..Default::default() };
        assert_eq!(names(15).named_groups(50.0), 1);
        // Three letters need 27 px: 15 groups of 1.8 px.
        assert_eq!(names(500).named_groups(1.8), 20);
        let chart = BarChart {
            bars: vec![Bars { values: vec![0.1; 500], ..Bars::default() }],
            size: [920.0, 300.0],
            ..names(500)
        };
        let svg = chart.svg();
        assert_eq!(svg.matches("<rect").count(), 500);
        assert_eq!(svg.matches("class=\"tick mid\"").count(), 25);
    }

    #[test]
    fn missing_values_have_no_bar() {
        let chart = BarChart {
            groups: vec!["1".to_owned(), "2".to_owned()],
            bars: vec![
                Bars { name: "EXP1".to_owned(), values: vec![0.1, f64::NAN], ..Bars::default() },
                Bars { name: "run".to_owned(), values: vec![0.2], ..Bars::default() },
            ],
            marks: vec![(0.077, "damage distance".to_owned())],
            size: [600.0, 240.0],
            ..BarChart::default()
        };
        let svg = chart.svg();
        assert_eq!(svg.matches("<title>1, ").count(), 2);
        assert_eq!(svg.matches("<title>2, ").count(), 0);
        assert!(svg.contains("damage distance") && !svg.contains("NaN"));
    }
}
