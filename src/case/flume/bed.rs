//! The validated flume: bed, mound and still water level.

use super::part::Part;
use super::terrain::SiteTerrain;
use crate::case::file::{FlumeFile, MoundFile, ShorewardEndFile};
use crate::case::reading::check::{Checker, as_text, at_least, lower_limit, more_than};
use crate::geometry::profile::Profile;
use crate::rigid::Cover;
use crate::waves::flume_model::layered::{Friction, RightEnd};

/// Largest allowed coordinate [m]. Larger values are probably typing errors.
const LARGEST_COORDINATE: f64 = 1e5;
/// Largest number of cells in the flume model.
const MOST_CELLS: f64 = 200_000.0;
/// Largest number of corner points of a bed.
const MOST_BED_POINTS: usize = 100_000;

/// Bed, mound and still water of the whole flume; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Flume {
    /// Ground: the bed with the mound and the parts of the structure that lie on it. With a terrain that is not
    /// the same across the domain, it is a profile below this terrain.
    pub profile: Profile,
    /// The terrain, if any.
    pub terrain: Option<SiteTerrain>,
    /// Ground below the terrain and in the flume model, if the terrain is not the same across the domain.
    pub bathymetry: Option<Bathymetry>,
    /// Ground on which units rest, if porous parts raise it above the bed of the water.
    pub rest: Option<Profile>,
    /// Bed without the mound.
    pub bed: Profile,
    /// Still water level [m].
    pub still_water_level: f64,
    /// The mound, if any.
    pub mound: Option<Mound>,
    /// Parts of the structure, and obstacles.
    pub parts: Vec<Part>,
    /// Materials of mound and parts on the profile.
    pub covers: Vec<Cover>,
    /// Material of bed and mound, an index into `Case::materials`.
    pub material: Option<usize>,
    /// Number of layers of the flume model.
    pub layers: usize,
    /// Cell length of the flume model along the flume [m].
    pub cell: f64,
    /// Friction of the bed in the flume model.
    pub friction: Friction,
    /// Boundary at the shoreward end of the flume model.
    pub right_end: RightEnd,
}

/// Ground of a flume with a terrain.
#[derive(Debug, Clone, PartialEq)]
pub struct Bathymetry {
    /// Ground without the terrain.
    pub ground: Profile,
    /// Ground of the flume model: the section of the terrain along a line, where it is above the other ground.
    pub section: Profile,
    /// y of this line [m].
    pub y: f64,
}

/// A trapezoidal mound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mound {
    /// x of the seaward and of the lee edge of the crest [m].
    pub crest_x: [f64; 2],
    /// Crest level [m].
    pub crest_z: f64,
    /// x of the seaward and of the lee toe [m].
    pub toe_x: [f64; 2],
}

impl Flume {
    /// Returns x of the seaward and of the shoreward end of the bed [m].
    pub fn ends(&self) -> [f64; 2] {
        let points = self.bed.points();
        [points[0][0], points[points.len() - 1][0]]
    }

    /// Returns name and content of each STL file that a run saves next to its case file.
    pub fn files(&self) -> impl Iterator<Item = (&str, &[u8])> {
        let of_terrain = self.terrain.iter().map(|terrain| (SiteTerrain::FILE, terrain.content.as_slice()));
        self.parts.iter().filter_map(Part::file).chain(of_terrain)
    }

    /// Returns the ground that does not belong to the terrain.
    pub fn ground(&self) -> &Profile {
        self.bathymetry.as_ref().map_or(&self.profile, |bathymetry| &bathymetry.ground)
    }

    /// Returns the ground in the flume model.
    pub fn section(&self) -> &Profile {
        self.bathymetry.as_ref().map_or(&self.profile, |bathymetry| &bathymetry.section)
    }

    /// Returns the level of the ground, which includes a terrain, at (x, y) [m].
    pub fn level(&self, x: f64, y: f64) -> f64 {
        let terrain = self.parts.iter().find_map(|part| part.as_body().filter(|body| body.terrain_x.is_some()));
        terrain.and_then(|body| body.surface.level(x, y)).map_or(self.profile.z(x), |z| z.max(self.profile.z(x)))
    }

    /// Returns the still water depth at x [m], above the mound where there is one; 0 where the ground is dry.
    pub fn still_depth(&self, x: f64) -> f64 {
        (self.still_water_level - self.section().z(x)).max(0.0)
    }

    /// Returns the still water depth at the seaward end of the flume [m].
    pub fn offshore_depth(&self) -> f64 {
        self.still_water_level - self.bed.points()[0][1]
    }
}

/// Validates the flume; `materials` are the indices of the materials of bed and mound.
pub fn validate(file: &FlumeFile, materials: [Option<usize>; 2], check: &mut Checker) -> Option<Flume> {
    let before = check.count();
    validate_bed(&file.bed_m, check);
    check.number(
        "flume.still_water_level_m",
        file.still_water_level_m,
        at_least(-LARGEST_COORDINATE).up_to(LARGEST_COORDINATE),
        "m",
        "write the level as a z coordinate like those of `flume.bed_m`",
    );
    if let Some(mound) = &file.mound {
        validate_mound_numbers(mound, check);
    }
    if let Some(n) = file.manning_s_m13 {
        let advice = "glass has 0.010, smooth concrete 0.013, gravel 0.03; leave the key out for no friction";
        check.number("flume.manning_s_m13", n, at_least(0.0).up_to(0.2), "s m^(-1/3)", advice);
    }
    validate_model(file, check);
    if check.count() > before {
        return None;
    }
    let bed = Profile::new(file.bed_m.clone());
    let right_end = validate_right_end(file, check)?;
    let (profile, mound) = match &file.mound {
        None => (bed.clone(), None),
        Some(mound) => {
            let (profile, mound) = place_mound(mound, &bed, check)?;
            (profile, Some(mound))
        }
    };
    let friction = file.manning_s_m13.map_or(Friction::None, |n_s_m13| Friction::Manning { n_s_m13 });
    let (still_water_level, layers, cell) = (file.still_water_level_m, file.layers as usize, file.cell_m);
    let [material, of_mound] = materials;
    let cover = mound.zip(of_mound).map(|(Mound { toe_x, .. }, material)| Cover { x: toe_x, material });
    let (parts, covers) = (Vec::new(), cover.into_iter().collect());
    Some(Flume {
        profile,
        terrain: None,
        bathymetry: None,
        rest: None,
        bed,
        still_water_level,
        mound,
        parts,
        covers,
        material,
        layers,
        cell,
        friction,
        right_end,
    })
}

fn validate_model(file: &FlumeFile, check: &mut Checker) {
    if !(1..=8).contains(&file.layers) {
        check.reject(
            "flume.layers",
            file.layers,
            "1 to 8",
            "2 layers are enough for a solitary wave, 3 for regular waves over a bar",
        );
    }
    let advice = "a twentieth of the depth or of the wavelength is enough, e.g. 0.05";
    let sound = check.number("flume.cell_m", file.cell_m, at_least(0.005).up_to(0.5), "m", advice);
    if let (true, [Some(first), Some(last)]) = (sound, [file.bed_m.first(), file.bed_m.last()]) {
        let length = last[0] - first[0];
        if length / file.cell_m > MOST_CELLS {
            check.reject(
                "flume.cell_m",
                as_text(file.cell_m),
                format!("at least {} m, for at most {MOST_CELLS} cells in the flume", lower_limit(length / MOST_CELLS)),
                "write a larger cell length or shorten `flume.bed_m`",
            );
        }
    }
}

/// Validates the boundary at the shoreward end; the bed must be valid.
fn validate_right_end(file: &FlumeFile, check: &mut Checker) -> Option<RightEnd> {
    let ([start, _], [end, bed_z]) = (file.bed_m[0], file.bed_m[file.bed_m.len() - 1]);
    match file.right_end {
        ShorewardEndFile::Wall {} => Some(RightEnd::Wall),
        ShorewardEndFile::Radiating {} if file.still_water_level_m > bed_z => Some(RightEnd::Radiating),
        ShorewardEndFile::Radiating {} => {
            check.reject(
                "flume.right_end.kind",
                "\"radiating\"",
                format!("\"wall\" where the bed ends on dry land (at z = {} m)", as_text(bed_z)),
                "let the bed end under water, or close the flume with a wall",
            );
            None
        }
        ShorewardEndFile::Sponge(sponge) => {
            let allowed = more_than(0.0).below(end - start);
            let advice = "the sponge must be shorter than the flume; a length of two wavelengths is enough";
            let sound = check.number("flume.right_end.length_m", sponge.length_m, allowed, "m", advice);
            sound.then_some(RightEnd::Sponge { length_m: sponge.length_m })
        }
    }
}

fn validate_bed(points: &[[f64; 2]], check: &mut Checker) {
    if points.len() < 2 || points.len() > MOST_BED_POINTS {
        check.reject(
            "flume.bed_m",
            format!("{} points", points.len()),
            format!("2 to {MOST_BED_POINTS} points"),
            "write the corner points [x, z] from the wavemaker to the shore, e.g. [[0, 0], [19, 0], [55, 1.2]]",
        );
    }
    let allowed = at_least(-LARGEST_COORDINATE).up_to(LARGEST_COORDINATE);
    for (index, [x, z]) in points.iter().enumerate() {
        check.number(&format!("flume.bed_m[{index}][0]"), *x, allowed, "m", "write x in metres");
        check.number(&format!("flume.bed_m[{index}][1]"), *z, allowed, "m", "write z in metres");
    }
    for (index, pair) in points.windows(2).enumerate() {
        // A segment shorter than a micrometre is a vertical step, which has no defined slope.
        if pair[1][0] - pair[0][0] < 1e-6 {
            check.reject(
                &format!("flume.bed_m[{}][0]", index + 1),
                as_text(pair[1][0]),
                format!("greater than the x of the previous point, {} m", as_text(pair[0][0])),
                "x must increase from point to point; write a step as a short steep segment",
            );
        }
    }
}

fn validate_mound_numbers(mound: &MoundFile, check: &mut Checker) {
    let allowed = at_least(-LARGEST_COORDINATE).up_to(LARGEST_COORDINATE);
    check.number("flume.mound.centre_x_m", mound.centre_x_m, allowed, "m", "write x of the middle of the crest");
    check.number(
        "flume.mound.crest_width_m",
        mound.crest_width_m,
        more_than(0.0).up_to(1000.0),
        "m",
        "write the width of the horizontal crest",
    );
    check.number("flume.mound.crest_z_m", mound.crest_z_m, allowed, "m", "write z of the crest");
    for (key, run) in
        [("seaward_run_per_rise", mound.seaward_run_per_rise), ("lee_run_per_rise", mound.lee_run_per_rise)]
    {
        check.number(
            &format!("flume.mound.{key}"),
            run,
            at_least(0.01).up_to(100.0),
            "",
            "write 2 for a slope of 1:2 (1 m up over 2 m)",
        );
    }
}

fn place_mound(mound: &MoundFile, bed: &Profile, check: &mut Checker) -> Option<(Profile, Mound)> {
    let half = 0.5 * mound.crest_width_m;
    let crest_x = [mound.centre_x_m - half, mound.centre_x_m + half];
    let points = bed.points();
    let ends = [points[0][0], points[points.len() - 1][0]];
    if !(crest_x[0] > ends[0] && crest_x[1] < ends[1] && crest_x[1] - crest_x[0] > 1e-6) {
        check.reject(
            "flume.mound.centre_x_m",
            as_text(mound.centre_x_m),
            format!("such that the whole crest lies on the bed, {} to {} m", as_text(ends[0]), as_text(ends[1])),
            "move the mound or lengthen the bed",
        );
        return None;
    }
    let bed_below = points.iter().filter(|p| p[0] > crest_x[0] && p[0] < crest_x[1]).map(|p| p[1]);
    let highest = bed_below.fold(bed.z(crest_x[0]).max(bed.z(crest_x[1])), f64::max);
    if mound.crest_z_m <= highest {
        check.reject(
            "flume.mound.crest_z_m",
            as_text(mound.crest_z_m),
            format!("above the bed under the crest, {} m", as_text(highest)),
            "write the level as a z coordinate like those of `flume.bed_m`, not as a height above the bed",
        );
        return None;
    }
    let profile = bed.with_mound(crest_x, mound.crest_z_m, [mound.seaward_run_per_rise, mound.lee_run_per_rise]);
    if profile.is_none() {
        check.reject(
            "flume.mound.crest_z_m",
            as_text(mound.crest_z_m),
            "such that both slopes of the mound meet the bed inside the flume",
            "lower the crest, steepen the slopes or lengthen the bed",
        );
    }
    let (profile, toe_x) = profile?;
    Some((profile, Mound { crest_x, crest_z: mound.crest_z_m, toe_x }))
}
