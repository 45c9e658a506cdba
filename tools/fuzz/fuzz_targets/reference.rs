//! Reference folders: `reference.json` and its tables.

#![no_main]

use std::sync::LazyLock;

use breakwater_fuzz::folder::{Role, Target, read, store};
use breakwater_fuzz::{cases, json::Mutator, random::Random, text};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let folder = cases::folder();
    folder.copy("cases/fudo/reference", ".");
    let role = |file| Role { file, case: "reference.json", seeds: vec![read(&format!("cases/fudo/reference/{file}"))] };
    let files = ["reference.json", "displacement_H2.6cm.csv", "convergence_H2.6cm.csv"];
    Target { folder, roles: files.map(role).into() }
});

static MUTATOR: LazyLock<Mutator> = LazyLock::new(|| Mutator::new(&TARGET.roles[0].seeds));

fuzz_target!(|input: &[u8]| TARGET.check(input));

fuzz_mutator!(|data: &mut [u8], size: usize, largest: usize, seed: u32| {
    let mut random = Random::new(seed);
    let mutated = TARGET.mutate(&data[..size], &mut random, |content, random| match content.first() {
        Some(b'{') => MUTATOR.mutate(content, random),
        _ => text::mutate(content, random),
    });
    store(&mutated, data, largest)
});
