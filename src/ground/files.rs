//! Reading whole files and replacing them atomically; hashes of inputs.

use super::problem::{Outcome, Problem};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use tempfile::TempPath;

/// Largest file that is read whole: robots, fits, universal files.
const LARGEST: u64 = 1 << 30;

/// Opens a regular file; its length in bytes. Devices and pipes never end, or never begin.
///
/// # Errors
/// No such file, not readable, or not a regular file.
pub fn open(path: &Path) -> Outcome<(File, u64)> {
    let opened = || {
        let about = std::fs::metadata(path)?;
        if !about.is_file() && !about.is_dir() {
            let what = "it is a device or a pipe, no regular file";
            return Err(std::io::Error::new(std::io::ErrorKind::InvalidInput, what));
        }
        Ok((File::open(path)?, about.len()))
    };
    opened().map_err(|error| unreadable(&error).in_file(path))
}

/// A file that the system does not let one read.
pub fn unreadable(error: &std::io::Error) -> Problem {
    let remedy = match error.kind() {
        std::io::ErrorKind::NotFound => "check the path; no such file is there",
        std::io::ErrorKind::PermissionDenied => "make the file readable for this user",
        _ => "check that it is a regular, readable file",
    };
    Problem::new(format!("cannot be read ({error})"), remedy)
}

/// The bytes of a file, or a problem naming it.
///
/// # Errors
/// As [`open`], and files above a gibibyte.
pub fn read_bytes(path: &Path) -> Outcome<Vec<u8>> {
    let (file, bytes) = open(path)?;
    if bytes > LARGEST {
        let what = format!("has {bytes} bytes, more than are read at once");
        return Err(Problem::new(what, "give a file below 1 GiB").in_file(path));
    }
    let mut content = Vec::new();
    let read = file.take(LARGEST).read_to_end(&mut content);
    read.map_err(|error| unreadable(&error).in_file(path))?;
    Ok(content)
}

/// The 1-based line of a text file on which `key` is set, in front matter too; 1 where none is.
pub fn line_setting(path: &Path, key: &str) -> usize {
    let sets = |line: &[u8]| {
        let line = String::from_utf8_lossy(line);
        let bare = line.trim_start_matches(['#', ' ', '\t', '\u{feff}']);
        let rest = bare.strip_prefix(key);
        rest.is_some_and(|rest| rest.trim_start().starts_with('='))
    };
    let bytes = read_bytes(path).unwrap_or_default();
    let found = bytes.split(|byte| *byte == b'\n').position(sets);
    found.map_or(1, |before| before + 1)
}

/// Name of a file, without its folder.
pub fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// SHA-256 as 64 hex digits.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// Replaces `path` in one step: written beside it, synced, renamed. A crash leaves the old file.
pub fn replace(path: &Path, content: &[u8]) -> Outcome<()> {
    replace_all(&[(path, content)])
}

/// Replaces several text files, as [`replace_all`] does.
pub fn replace_texts(files: &[(PathBuf, String)]) -> Outcome<()> {
    let all: Vec<(&Path, &[u8])> = files
        .iter()
        .map(|(path, text)| (path.as_path(), text.as_bytes()))
        .collect();
    replace_all(&all)
}

/// Replaces several files: all are written beside their places before the first is renamed, so
/// that a full disk or a forbidden folder leaves every old file.
pub fn replace_all(files: &[(&Path, &[u8])]) -> Outcome<()> {
    let refused = |path: &Path, error: std::io::Error| {
        Problem::new(
            format!("cannot be written ({error})"),
            "check that the folder exists, is writable and has room",
        )
        .in_file(path)
    };
    let mut folders: Vec<&Path> = files.iter().map(|(path, _)| folder(path)).collect();
    folders.sort_unstable();
    folders.dedup();
    folders.into_iter().for_each(sweep);
    let mut staged = Vec::new();
    for (path, content) in files {
        if path.is_dir() {
            let what = std::io::Error::from(std::io::ErrorKind::IsADirectory);
            return Err(refused(path, what));
        }
        staged.push(stage(path, content).map_err(|e| refused(path, e))?);
    }
    for (file, (path, _)) in staged.into_iter().zip(files) {
        file.persist(path).map_err(|e| refused(path, e.error))?;
    }
    Ok(())
}

/// The folder of a file.
fn folder(path: &Path) -> &Path {
    let own = path.parent().filter(|p| !p.as_os_str().is_empty());
    own.unwrap_or(Path::new("."))
}

/// Writes a temporary file in the folder of `path`; it removes itself unless it is renamed. It is closed: a campaign has more
/// files than a process may hold open.
fn stage(path: &Path, content: &[u8]) -> std::io::Result<TempPath> {
    let folder = folder(path);
    std::fs::create_dir_all(folder)?;
    let mut file = tempfile::Builder::new()
        .prefix(&format!("{TEMPORARY}{}-", std::process::id()))
        .suffix(".tmp")
        .tempfile_in(folder)?;
    file.write_all(content)?;
    file.as_file().sync_all()?;
    set_plain_permissions(file.as_file())?;
    Ok(file.into_temp_path())
}

/// Start of the names of temporary files; the number of the process that writes them follows.
const TEMPORARY: &str = ".ident-";
/// Age beyond which a temporary file has no writer any more, where processes cannot be asked.
const STALE: std::time::Duration = std::time::Duration::from_secs(24 * 3600);

/// Removes what killed runs left in a folder; nothing can be done if that fails.
fn sweep(folder: &Path) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().to_string();
        let inner = name
            .strip_prefix(TEMPORARY)
            .and_then(|n| n.strip_suffix(".tmp"));
        if inner.is_some_and(|inner| is_abandoned(inner, &entry)) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Whether nobody writes a temporary file any more.
fn is_abandoned(inner: &str, entry: &std::fs::DirEntry) -> bool {
    let process = inner.split('-').next().and_then(|n| n.parse::<u32>().ok());
    match process {
        Some(own) if own == std::process::id() => false,
        Some(other) if Path::new("/proc/self").exists() => {
            !Path::new(&format!("/proc/{other}")).exists()
        }
        _ => {
            let written = entry.metadata().and_then(|about| about.modified());
            let age = written.ok().and_then(|at| at.elapsed().ok());
            age.is_some_and(|age| age > STALE)
        }
    }
}

#[cfg(unix)]
fn set_plain_permissions(file: &std::fs::File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn set_plain_permissions(_: &std::fs::File) -> std::io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_whole_files_and_leaves_no_temporary() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/a.toml");
        replace(&path, b"one").unwrap();
        replace(&path, b"two").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        assert_eq!(
            std::fs::read_dir(path.parent().unwrap()).unwrap().count(),
            1
        );
    }

    #[test]
    fn hash_of_nothing() {
        assert!(sha256(b"").starts_with("e3b0c44298fc1c14"));
    }
}
