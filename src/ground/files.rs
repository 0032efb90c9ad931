//! Reading whole files and replacing them atomically; hashes of inputs.

use super::problem::{Outcome, Problem};
use sha2::{Digest, Sha256};
use std::io::Write;
use std::path::Path;
use tempfile::NamedTempFile;

/// The bytes of a file, or a problem naming it.
pub fn read_bytes(path: &Path) -> Outcome<Vec<u8>> {
    std::fs::read(path).map_err(|error| {
        let remedy = match error.kind() {
            std::io::ErrorKind::NotFound => "check the path; `ident` reads it from here",
            std::io::ErrorKind::PermissionDenied => "make the file readable for this user",
            _ => "check that it is a regular, readable file",
        };
        Problem::new(format!("cannot be read ({error})"), remedy).in_file(path)
    })
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
    let mut staged = Vec::new();
    for (path, content) in files {
        staged.push(stage(path, content).map_err(|e| refused(path, e))?);
    }
    for (file, (path, _)) in staged.into_iter().zip(files) {
        file.persist(path).map_err(|e| refused(path, e.error))?;
    }
    Ok(())
}

/// Writes a temporary file in the folder of `path`; it removes itself unless it is renamed.
fn stage(path: &Path, content: &[u8]) -> std::io::Result<NamedTempFile> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let mut file = tempfile::Builder::new()
        .prefix(".ident-")
        .suffix(".tmp")
        .tempfile_in(folder)?;
    file.write_all(content)?;
    file.as_file().sync_all()?;
    set_plain_permissions(file.as_file())?;
    Ok(file)
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
