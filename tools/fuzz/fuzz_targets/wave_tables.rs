//! Tables with waves of SWASH, OpenFOAM and DualSPHysics.

#![no_main]

use std::sync::LazyLock;

use breakwater_fuzz::folder::{Role, Target, store};
use breakwater_fuzz::{cases, random::Random, text, wave_tables};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let folder = cases::folder();
    wave_tables::write(&folder, ".");
    let cases = ["velx.json", "swash.json", "probes.json", "line.json"];
    for (name, text) in cases.iter().zip(wave_tables::cases()) {
        folder.write(name, &text);
    }
    let role = |(file, content): (&'static str, Vec<u8>)| {
        let case = match file {
            "piston_velx.csv" => cases[0],
            "level.tbl" | "velocity.tbl" => cases[1],
            _ if file.starts_with("probes") => cases[2],
            _ => cases[3],
        };
        Role { file, case, seeds: vec![content] }
    };
    Target { folder, roles: wave_tables::files().into_iter().map(role).collect() }
});

fuzz_target!(|input: &[u8]| TARGET.check(input));

fuzz_mutator!(|data: &mut [u8], size: usize, largest: usize, seed: u32| {
    let mut random = Random::new(seed);
    let mutated = TARGET.mutate(&data[..size], &mut random, text::mutate);
    store(&mutated, data, largest)
});
