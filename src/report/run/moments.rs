//! Side views of water and units at a few recorded times (moments), and one of these views as a separate picture.

use super::super::plot::{escape, short};
use super::folder::RunFolder;
use super::motion::{UnitMotion, mean_and_deviation};
use super::scene::{ImpactScene, Poses, bed_in, range, unit_radius};
use super::solids::ViewDirection;
use super::water::{Dot, Slab, SpeedScale};
use super::window::{Window, label, svg};
use crate::output::{OutputError, PolyDataMoments};

/// Length of the flume that is shown on each side of the mound [m].
const BESIDE_MOUND_M: f64 = 0.5;
/// A corner of the bed profile belongs to the mound if its distance from the units is less than this value [m].
const MOUND_REACH_M: f64 = 1.5;
/// Time between the peak of the water force and an additional moment [s]. The report shows this moment if the snapshot
/// at the peak speed of the units is already chosen for another reason.
const LATER_S: f64 = 0.5;
/// Share of the water particles that are below the upper edge of the window [-]; the particles above it are spray.
const UNDER_EDGE: f64 = 0.999;
/// Space that the label of the wavemaker needs [px].
const WAVEMAKER_ROOM: f64 = 100.0;
/// Margin around the drawing in `picture.svg`, height of the heading and height of the legend [px].
const MARGIN: f64 = 40.0;
const HEADING: f64 = 74.0;
const LEGEND: f64 = 60.0;
/// Font size of the title of `picture.svg` [px]; a long title gets a smaller font.
const TITLE_SIZE: f64 = 19.0;
/// Width of a letter divided by the font size [-].
const LETTER: f64 = 0.58;

/// The snapshots extend to the wavemaker if the first water particle is within this distance of it [particle spacings].
/// Otherwise the snapshots contain only the water in `output.fluid_box_m`.
const AT_WAVEMAKER: f64 = 2.0;

/// One recorded time of the run, with the data for its drawing.
struct Moment {
    time_s: f64,
    words: String,
    /// True if `picture.svg` shows this moment.
    pictured: bool,
    dots: Vec<Dot>,
    /// Position of the wavemaker [m], taken as the seaward end of the water; `None` if the wavemaker is not shown.
    wavemaker_x: Option<f64>,
    poses: Poses,
}

/// The moments of a run that the report shows, and the settings of their drawings.
pub struct Moments<'a> {
    run: &'a RunFolder,
    scene: ImpactScene<'a>,
    slab: Slab,
    scale: SpeedScale,
    moments: Vec<Moment>,
}

impl<'a> Moments<'a> {
    /// Chooses the moments of a run and reads their water particles. `None` if the run recorded no particles or no
    /// velocities.
    ///
    /// # Errors
    /// If the file with the water particles cannot be read.
    pub fn read(run: &'a RunFolder) -> Result<Option<Self>, OutputError> {
        if !run.has(RunFolder::WATER) || run.summary.dp_m <= 0.0 {
            return Ok(None);
        }
        let water = PolyDataMoments::open(&run.dir.join(RunFolder::WATER))?;
        if !water.has("velocity") {
            return Ok(None);
        }
        let slab = Slab::in_the_middle(run.summary.domain_width_m, run.summary.dp_m);
        let x = shown_x(run);
        let mut moments = Vec::new();
        let mut shows_wavemaker = run.summary.wave.is_some();
        for Choice { step, words, pictured } in choices(run, &water) {
            let time_s = water.times_s()[step];
            let points_m = water.points(step)?;
            let dots = slab.dots(&points_m, &water.vectors(step, "velocity")?, x);
            let ends = range(points_m.iter().map(|p| f64::from(p[0])));
            if step == 0 {
                let at_wavemaker = run.summary.domain_x_m[0] + AT_WAVEMAKER * run.summary.dp_m;
                shows_wavemaker &= ends.is_some_and(|[seaward, _]| seaward < at_wavemaker);
            }
            let wavemaker_x = ends.filter(|_| shows_wavemaker).map(|[seaward, _]| seaward);
            let poses = run.motions.iter().filter_map(|m| Some((m.unit, m.at(time_s)?))).collect();
            moments.push(Moment { time_s, words, pictured, dots, wavemaker_x, poses });
        }
        if moments.iter().all(|moment| moment.dots.is_empty()) {
            return Ok(None);
        }
        let scale = SpeedScale::holding(moments.iter().map(|moment| moment.dots.as_slice()));
        let scene = ImpactScene::new(run, Window::new(x, shown_z(run, x, heights(run, &moments))), ViewDirection::Side);
        Ok(Some(Self { run, scene, slab, scale, moments }))
    }

    /// Returns the time of the moment that `picture.svg` shows [s].
    pub fn pictured_s(&self) -> Option<f64> {
        self.moments.iter().find(|moment| moment.pictured).map(|moment| moment.time_s)
    }

    /// Returns the heading of the report section.
    pub fn heading(&self) -> &'static str {
        if self.run.motions.is_empty() { "The wave in the flume" } else { "The wave at the units" }
    }

    /// Returns the content of the report section as HTML.
    pub fn section(&self) -> String {
        let mut html = format!(
            "<p>Side views at equal horizontal and vertical scale. Dots are water particles less than {} mm from \
             y = {} m, coloured by speed; the darkest colour includes all faster particles{} Flume time 0 is the start \
             of the wavemaker.</p>\n<figure>{}</figure>\n",
            short(1000.0 * self.slab.half(), 1),
            short(self.slab.y, 4),
            if self.run.motions.is_empty() {
                "."
            } else {
                ". All units are shown, including those in front of and behind this slice."
            },
            svg("Colour scale of the water speed", 48.0, &self.scale.legend([58.0, 0.0], 340.0))
        );
        for (number, moment) in self.moments.iter().enumerate() {
            let title = format!("{} s: {}", short(moment.time_s, 2), moment.words);
            let drawing = svg(&title, self.scene.window.height(), &self.drawing(&format!("moment{number}"), moment));
            let (time, words) = (short(moment.time_s, 2), escape(&moment.words));
            html +=
                &format!("<figure>{drawing}<figcaption><strong>{time} s.</strong> {words}.</figcaption></figure>\n");
        }
        html
    }

    /// Returns the moment chosen for `picture.svg` as a self-contained SVG, with background and fonts.
    pub fn picture(&self) -> Option<String> {
        let moment = self.moments.iter().find(|moment| moment.pictured)?;
        let (width, drawing_height) = (super::window::WIDTH + 2.0 * MARGIN, self.scene.window.height());
        let height = HEADING + drawing_height + LEGEND;
        let title = escape(&self.run.summary.title);
        let letters = self.run.summary.title.chars().count().max(1) as f64;
        let title_size = TITLE_SIZE.min((width - 2.0 * MARGIN) / (LETTER * letters));
        let words = format!("Flume time {} s. {}.", short(moment.time_s, 2), moment.words);
        let style = [include_str!("picture.css"), include_str!("../shades.css")].concat();
        let drawing = self.drawing("window", moment);
        let legend = self.scale.legend([58.0, drawing_height + 6.0], 340.0);
        Some(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width} {height:.0}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>\n\
             <style>\n{style}</style>\n<rect class=\"paper\" width=\"{width}\" height=\"{height:.0}\" rx=\"6\"/>\n\
             <text class=\"title\" x=\"{MARGIN}\" y=\"36\" font-size=\"{title_size:.1}\">{title}</text>{}\n\
             <g transform=\"translate({MARGIN} {HEADING})\">\n{drawing}{legend}</g>\n</svg>\n",
            label(MARGIN, 58.0, "label", &words),
        ))
    }

    /// Draws the label of the wavemaker, if the wavemaker is in the window and there is space for the label.
    fn wavemaker(&self, moment: &Moment) -> String {
        let Some(x) = moment.wavemaker_x else { return String::new() };
        let [left, _, _, _] = self.scene.window.edges();
        let [end, y] = self.scene.window.at(x, self.run.summary.still_water_level_m);
        let words = "wavemaker \u{2192}";
        if end - left < WAVEMAKER_ROOM { String::new() } else { label(end - 10.0, y + 24.0, "note end halo", words) }
    }

    fn drawing(&self, id: &str, moment: &Moment) -> String {
        let drawing = self.scene.sky()
            + &self.scale.drawing(&moment.dots, &self.scene.window, self.slab.spacing)
            + &self.scene.bed()
            + &self.scene.units(&moment.poses, false)
            + &self.scene.still_water_level()
            + &self.wavemaker(moment);
        self.scene.window.framed(id, "z [m]", &drawing)
    }
}

/// A snapshot chosen for the report: its index, its description, and whether `picture.svg` shows it.
struct Choice {
    step: usize,
    words: String,
    pictured: bool,
}

/// Chooses the moments, in chronological order. Without units or without a water force, four equally spaced moments are
/// chosen.
fn choices(run: &RunFolder, water: &PolyDataMoments) -> Vec<Choice> {
    let Some(last) = water.times_s().len().checked_sub(1) else { return Vec::new() };
    let mut choices = vec![Choice { step: 0, words: "Start of the particle simulation".to_owned(), pictured: false }];
    let mut add = |step: usize, words: String, pictured: bool| {
        let new = choices.iter().all(|choice| choice.step != step);
        if new {
            choices.push(Choice { step, words, pictured });
        }
        new
    };
    let force = largest_mean(run, |motion| motion.fluid_change_n(0));
    if let Some((force_s, force_n)) = force {
        let towards = if force_n < 0.0 { "seaward" } else { "shoreward" };
        let at = short(force_s, 2);
        let words = format!(
            "Near the peak of the mean horizontal force of the water, {} N per unit {towards} at {at} s",
            short(force_n.abs(), 2)
        );
        add(water.nearest(force_s).unwrap_or(0), words, true);
        let fastest = largest_mean(run, UnitMotion::speed_m_s).is_some_and(|(fastest_s, speed)| {
            let words = format!(
                "Near the peak of the mean speed of the units, {} m/s at {} s",
                short(speed, 2),
                short(fastest_s, 2)
            );
            add(water.nearest(fastest_s).unwrap_or(0), words, false)
        });
        if !fastest {
            let words = format!("{} s after the peak of the mean horizontal force of the water", short(LATER_S, 1));
            add(water.nearest(force_s + LATER_S).unwrap_or(0), words, false);
        }
    } else {
        for third in 1..3 {
            add(last * third / 3, "During the run".to_owned(), false);
        }
    }
    add(last, "End of the run".to_owned(), false);
    choices.sort_by_key(|choice| choice.step);
    if let Some(end) = choices.last_mut().filter(|_| force.is_none()) {
        end.pictured = true;
    }
    choices
}

/// Returns the time [s] and the value at which the mean over the units has its largest magnitude; `None` if the mean is
/// always zero.
fn largest_mean(run: &RunFolder, history: impl Fn(&UnitMotion) -> Vec<f64>) -> Option<(f64, f64)> {
    let (mean, _) = mean_and_deviation(&run.motions.iter().map(history).collect::<Vec<_>>());
    let times = &run.motions.first()?.time_s;
    let known = times.iter().copied().zip(mean).filter(|(_, value)| value.is_finite() && *value != 0.0);
    known.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
}

/// Range of x that the drawing shows [m]: the mound with some water on each side, and all positions of all units.
pub fn shown_x(run: &RunFolder) -> [f64; 2] {
    let radius = unit_radius(run);
    let [begin, end] = run.summary.domain_x_m;
    let units = range(run.motions.iter().flat_map(|m| m.position_m.iter().map(|p| p[0])));
    let near = units.map_or([begin, end], |[low, high]| [low - MOUND_REACH_M, high + MOUND_REACH_M]);
    let corners = run.profile.iter().skip(1).map(|p| p[0]).take(run.profile.len().saturating_sub(2));
    let mound = range(corners.filter(|x| near[0] < *x && *x < near[1] && begin < *x && *x < end));
    let wide = |[low, high]: [f64; 2], room: f64| [low - room, high + room];
    let shown = mound.map(|mound| wide(mound, BESIDE_MOUND_M)).into_iter().chain(units.map(|u| wide(u, 5.0 * radius)));
    let [low, high] = range(shown.flatten()).unwrap_or([begin, end]);
    if end > begin { [low.max(begin), high.min(end)] } else { [low, high] }
}

/// Range of z that the drawing shows [m]: from below the bed to above the still water and the heights `others` [m].
pub fn shown_z(run: &RunFolder, x: [f64; 2], others: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let radius = unit_radius(run);
    let bed = bed_in(run, x).into_iter().map(|p| p[1]);
    let [low, high] = range(bed.chain(others).chain([run.summary.still_water_level_m])).unwrap_or([0.0, 1.0]);
    [low - 0.5 * radius, high + 0.6 * radius]
}

/// Heights of the water, without spray, and of the units in the moments [m].
fn heights(run: &RunFolder, moments: &[Moment]) -> Vec<f64> {
    let radius = unit_radius(run);
    let highest = |moment: &Moment| {
        let mut heights: Vec<f64> = moment.dots.iter().map(|dot| dot.z).collect();
        heights.sort_by(f64::total_cmp);
        heights.get((UNDER_EDGE * heights.len() as f64) as usize).copied()
    };
    let units = moments
        .iter()
        .flat_map(|m| m.poses.iter().flat_map(|(_, pose)| [-radius, radius].map(|r| pose.position_m[2] + r)));
    moments.iter().filter_map(highest).chain(units).collect()
}
