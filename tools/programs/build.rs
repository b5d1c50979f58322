//! Puts commit and dirty mark into the version string, so that streams say which program made them.

use std::process::Command;

fn main() {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let version = std::env::var("CARGO_PKG_VERSION").unwrap_or_default();
    let revision = git(&["rev-parse", "--short=8", "HEAD"]);
    let dirty = git(&["status", "--porcelain", "--untracked-files=no"]).is_some_and(|status| !status.is_empty());
    let version = match revision {
        Some(revision) => format!("{version} (rev {revision}{})", if dirty { ", dirty" } else { "" }),
        None => format!("{version} (rev unknown)"),
    };
    println!("cargo::rustc-env=PM_VERSION={version}");
    // A new commit or a changed source changes the string.
    for path in ["../../.git/HEAD", "../../.git/logs/HEAD", "../../.git/index", "..", "../../formats/src"] {
        if std::path::Path::new(path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
}
