//! A folder with small valid files, one of which is replaced by each input.

use std::fs;
use std::path::{Path, PathBuf};

/// Root of the repository.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A temporary folder in memory.
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Creates an empty folder that only this process uses.
    pub fn new() -> Self {
        let memory = Path::new("/dev/shm");
        let parent = if memory.is_dir() { memory.to_owned() } else { std::env::temp_dir() };
        let path = parent.join(format!("breakwater-fuzz-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self { path }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file of the folder.
    pub fn write(&self, name: &str, content: &[u8]) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    /// Copies a file or a folder of the repository to the folder.
    pub fn copy(&self, from: &str, to: &str) {
        copy(&repository().join(from), &self.path(to));
    }

    /// Runs `breakwater check` on a file of the folder.
    pub fn check(&self, name: &str) {
        let path = self.path(name).into_os_string();
        breakwater::cli::run_command(["breakwater".into(), "check".into(), path]);
    }
}

fn copy(from: &Path, to: &Path) {
    if !from.is_dir() {
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(from, to).unwrap();
        return;
    }
    for entry in fs::read_dir(from).unwrap() {
        let name = entry.unwrap().file_name();
        copy(&from.join(&name), &to.join(&name));
    }
}

/// Reads a file of the repository.
pub fn read(name: &str) -> Vec<u8> {
    fs::read(repository().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A file that is replaced by the input, and the case that reads this file.
pub struct Role {
    pub file: &'static str,
    pub case: &'static str,
    /// Valid contents of the file.
    pub seeds: Vec<Vec<u8>>,
}

/// A prepared folder with the roles that an input can have. The first byte of an input selects the role.
pub struct Target {
    pub folder: Folder,
    pub roles: Vec<Role>,
}

impl Target {
    /// Checks the case of the selected role with the rest of the input as the content of the file.
    pub fn check(&self, input: &[u8]) {
        let Some((first, content)) = input.split_first() else { return };
        let role = &self.roles[usize::from(*first) % self.roles.len()];
        self.folder.write(role.file, content);
        self.folder.check(role.case);
        // Other roles may read the same file.
        self.folder.write(role.file, &role.seeds[0]);
    }

    /// Returns an input with valid content.
    pub fn seed(&self, random: &mut crate::random::Random) -> Vec<u8> {
        let role = random.below(self.roles.len());
        let mut input = vec![role as u8];
        input.extend(random.pick(&self.roles[role].seeds));
        input
    }

    /// Mutates an input; `mutate` changes the content of the file. An input without content becomes a valid one first.
    pub fn mutate(
        &self,
        input: &[u8],
        random: &mut crate::random::Random,
        mutate: impl FnOnce(&[u8], &mut crate::random::Random) -> Vec<u8>,
    ) -> Vec<u8> {
        let input = if input.len() < 3 || random.below(20) == 0 { self.seed(random) } else { input.to_vec() };
        let mut mutated = vec![input[0]];
        mutated.extend(mutate(&input[1..], random));
        mutated
    }
}

/// Writes a mutated input into the buffer of the fuzzer; returns its length. An input that does not fit is cut.
pub fn store(mutated: &[u8], buffer: &mut [u8], largest: usize) -> usize {
    let length = mutated.len().min(largest).min(buffer.len());
    buffer[..length].copy_from_slice(&mutated[..length]);
    length
}
