//! Tables of cracks, pieces and bodies.

use super::folder::{FractureFolder, place_in_words};
use crate::report::page::grouped;
use crate::report::plot::{escape, short};

/// Maximum number of rows of a table; `summary.json` lists all cracks and pieces.
const MAX_ROWS: usize = 20;

/// Table of crack initiation, in chronological order.
pub fn cracks(run: &FractureFolder) -> String {
    let all = &run.summary.initiation;
    let row = |(index, crack): (usize, &crate::simulation::fracture::summary::InitiationSummary)| {
        let [x, y, z] = crack.place.map(to_millimetres);
        let mode = if crack.mode == "sliding" { "sliding&nbsp;(II)" } else { "opening&nbsp;(I)" };
        format!(
            "<tr><td>{}</td><td>{:.3}</td><td>{}</td><td class=\"words\">{}</td><td>{x}</td><td>{y}</td><td>{z}</td><td>{mode}</td>\
             <td>{}</td></tr>\n",
            index + 1,
            run.clock_ms(crack.t_s),
            escape(&crack.body),
            escape(&place_in_words(crack)),
            short(crack.area_m2 * 1e4, 1)
        )
    };
    let mut rows: String = all.iter().enumerate().take(MAX_ROWS).map(row).collect();
    if all.len() > MAX_ROWS {
        let rest: f64 = all[MAX_ROWS..].iter().map(|crack| crack.area_m2).sum();
        rows += &format!(
            "<tr class=\"sum\"><td colspan=\"8\">{} more cracks, listed in summary.json</td><td>{}</td></tr>\n",
            all.len() - MAX_ROWS,
            short(rest * 1e4, 1)
        );
    }
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr><th>Crack</th><th>{} [ms]</th><th>Body</th><th class=\"words\">Initiation</th>\
         <th>x&nbsp;[m]</th><th>y&nbsp;[m]</th><th>z&nbsp;[m]</th><th>Mode</th><th>Final area [cm\u{b2}]</th></tr></thead>\n\
         <tbody>\n{rows}</tbody></table></div>\n",
        capital(run.clock_name())
    )
}

/// Table of the pieces at the end of the run, the heaviest first.
pub fn fragments(run: &FractureFolder) -> String {
    let all = &run.summary.fragments;
    let mass_of = |body: &str| all.iter().filter(|f| f.body == body).map(|f| f.mass_kg).sum::<f64>();
    let row = |(index, piece): (usize, &crate::simulation::fracture::summary::FragmentSummary)| {
        let [x, y, z] = piece.centre_m.map(to_millimetres);
        let speed = piece.velocity_m_s.iter().map(|v| v * v).sum::<f64>().sqrt();
        format!(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{x}</td><td>{y}</td><td>{z}</td><td>{}</td></tr>\n",
            index + 1,
            escape(&piece.body),
            grouped(piece.tets as u64),
            short(piece.mass_kg, 3),
            short(100.0 * piece.mass_kg / mass_of(&piece.body), 2),
            short(speed, 3)
        )
    };
    let mut rows: String = all.iter().enumerate().take(MAX_ROWS).map(row).collect();
    if all.len() > MAX_ROWS {
        let rest: f64 = all[MAX_ROWS..].iter().map(|piece| piece.mass_kg).sum();
        rows += &format!(
            "<tr class=\"sum\"><td colspan=\"3\">{} smaller pieces</td><td>{}</td><td colspan=\"5\"></td></tr>\n",
            all.len() - MAX_ROWS,
            short(rest, 3)
        );
    }
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr><th>Piece</th><th>Body</th><th>Tetra&shy;hedra</th><th>Mass [kg]</th>\
         <th>Share of the body [%]</th><th>Centre x [m]</th><th>y [m]</th><th>z [m]</th><th>Speed [m/s]</th></tr></thead>\n\
         <tbody>\n{rows}</tbody></table></div>\n"
    )
}

/// Table of the bodies with mesh and material.
pub fn bodies(run: &FractureFolder) -> String {
    let case = &run.case;
    let mut rows = String::new();
    for ((name, body), quality) in case.names.iter().zip(&case.setup.bodies).zip(&case.mesh.quality) {
        let (elastic, none) = (&body.elastic, "\u{2013}".to_owned());
        let strength = body.cohesion.map(|cohesion| cohesion.strength);
        let strength_value = |value: fn(&crate::femdem::material::Strength) -> f64| {
            strength.as_ref().map_or(none.clone(), |strength| short(value(strength), 2))
        };
        rows += &format!(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
             <td>{}</td></tr>\n",
            escape(name),
            grouped(quality.tets as u64),
            short(quality.edge_mean * 1e3, 1),
            short(quality.volume * elastic.density, 1),
            short(elastic.density, 0),
            short(elastic.young_modulus * 1e-9, 2),
            short(elastic.poisson_ratio, 2),
            strength_value(|s| s.tensile * 1e-6),
            strength_value(|s| s.cohesion * 1e-6),
            strength_value(|s| s.friction.atan().to_degrees()),
            strength_value(|s| s.opening_energy)
        );
    }
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr><th>Body</th><th>Tetra&shy;hedra</th><th>Mean edge length [mm]</th><th>Mass [kg]</th>\
         <th>Density [kg/m\u{b3}]</th><th>Young's modulus [GPa]</th><th>Poisson ratio</th><th>Tensile strength [MPa]</th><th>Cohesion [MPa]</th>\
         <th>Friction angle [&deg;]</th><th>Fracture energy, mode I [J/m\u{b2}]</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n\
         <figcaption>Bodies without a strength deform but do not crack.</figcaption>\n"
    )
}

/// Formats a coordinate in metres, rounded to whole millimetres, without a minus sign before zero.
fn to_millimetres(coordinate: f64) -> String {
    let rounded = (coordinate * 1e3).round() / 1e3 + 0.0;
    format!("{rounded:.3}").replace('-', "\u{2212}")
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_have_no_negative_zero() {
        assert_eq!(to_millimetres(-0.0001), "0.000");
        assert_eq!(to_millimetres(-0.1346), "\u{2212}0.135");
    }
}
