//! Placement files, alone and as the `placement_file` of a case.

#![no_main]

use std::sync::LazyLock;

use breakwater_fuzz::folder::{Role, Target, read, store};
use breakwater_fuzz::{cases, json::Mutator, random::Random, text};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let folder = cases::folder();
    folder.copy("cases/contact/armour-layer.json", "case.json");
    let seeds = vec![read("cases/contact/armour-layer.placement.json")];
    folder.write("armour-layer.placement.json", &seeds[0]);
    let file = "armour-layer.placement.json";
    Target {
        folder,
        roles: vec![Role { file, case: "case.json", seeds: seeds.clone() }, Role { file, case: file, seeds }],
    }
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
