//! Claim: a page that sends its reader to a file of code (`name.rs`, with or without folders before it) names
//! one that is there. Pages of history (`moved.md`, `log.md`, `failed.md`) tell of files that went.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::{Path, PathBuf};

/// The files below `folder` whose names end with `ending`.
fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() && path.file_name().unwrap() != "target" {
            files(&path, ending, found);
        } else if path.to_string_lossy().ends_with(ending) {
            found.push(path);
        }
    }
}

#[test]
fn each_file_of_code_on_a_page_is_there() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut code = Vec::new();
    for folder in ["crates", "verification", "python"] {
        files(&top.join(folder), ".rs", &mut code);
    }
    let code: Vec<String> = code.iter().map(|path| path.to_string_lossy().replace('\\', "/")).collect();
    let mut pages = vec![top.join("CONTRIBUTING.md"), top.join("README.md")];
    files(&top.join("docs/src"), ".md", &mut pages);
    let history = ["moved.md", "log.md", "failed.md"];
    pages.retain(|page| !history.iter().any(|name| page.ends_with(name)));
    let mut named = 0;
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap();
        for word in text.split('`').skip(1).step_by(2).filter(|word| is_file(word)) {
            named += 1;
            let end = format!("/{word}");
            assert!(code.iter().any(|path| path.ends_with(&end)), "{}: no file {word}", page.display());
        }
    }
    assert!(named > 100, "{named}");
}

/// True where a quoted word names a file of code.
fn is_file(word: &str) -> bool {
    let path = word.strip_suffix(".rs");
    path.is_some_and(|path| path.chars().all(|c| c.is_ascii_alphanumeric() || "_/-.".contains(c)))
}
