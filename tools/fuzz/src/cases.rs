//! The cases of the repository as valid inputs, and the files that they read.

use std::fs;

use crate::folder::{Folder, read, repository};
use crate::wave_tables;

/// Folder of the mutated case; it has all files that a case of the repository names.
pub const PLACE: &str = "cases/fuzz";

/// Creates a folder with the cases of the repository and the files that they read.
pub fn folder() -> Folder {
    let folder = Folder::new();
    folder.copy("cases", "cases");
    for from in ["cases/contact", "cases/fudo", "cases/tutorial", "tests/data/meshes"] {
        folder.copy(from, PLACE);
    }
    folder.copy("cases/fracture/meshes", &format!("{PLACE}/meshes"));
    wave_tables::write(&folder, PLACE);
    folder
}

/// Returns the texts of all case files of the repository and of cases with waves from files.
pub fn texts() -> Vec<Vec<u8>> {
    let mut texts = Vec::new();
    for group in fs::read_dir(repository().join("cases")).unwrap() {
        let group = group.unwrap().file_name().into_string().unwrap();
        for file in fs::read_dir(repository().join("cases").join(&group)).unwrap() {
            let file = file.unwrap().file_name().into_string().unwrap();
            if file.ends_with(".json") {
                texts.push(read(&format!("cases/{group}/{file}")));
            }
        }
    }
    texts.push(read("cases/fudo/reference/reference.json"));
    texts.extend(wave_tables::cases());
    texts.sort();
    texts
}
