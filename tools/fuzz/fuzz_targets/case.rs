//! Input files of every kind: `breakwater check`, and the checks of `breakwater place`.

#![no_main]

use std::sync::LazyLock;

use breakwater::case::{Document, InputKind, LayerJob};
use breakwater_fuzz::{cases, folder, folder::Folder, json::Mutator, random::Random};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

static FOLDER: LazyLock<Folder> = LazyLock::new(cases::folder);
static SEEDS: LazyLock<Vec<Vec<u8>>> = LazyLock::new(cases::texts);
static MUTATOR: LazyLock<Mutator> = LazyLock::new(|| Mutator::new(SEEDS.iter()));

fuzz_target!(|input: &[u8]| {
    let name = format!("{}/case-of-the-fuzzer.json", cases::PLACE);
    FOLDER.write(&name, input);
    FOLDER.check(&name);
    if let Ok(document) = Document::read(&FOLDER.path(&name))
        && matches!(document.kind(), InputKind::Flume | InputKind::DryTest)
        && document.text.contains("armour")
    {
        let _ = LayerJob::from_document(&document);
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, largest: usize, seed: u32| {
    let mut random = Random::new(seed);
    let from_seed = size < 3 || random.below(20) == 0;
    let input = if from_seed { random.pick(&SEEDS).clone() } else { data[..size].to_vec() };
    folder::store(&MUTATOR.mutate(&input, &mut random), data, largest)
});
