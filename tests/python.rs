//! The recipes of `docs/python.md`, run by Python where it exists.

use crate::support;

use std::process::Command;
use support::root;

/// Returns the blocks of Python on the page.
fn blocks(page: &str) -> Vec<&str> {
    page.split("```python\n").skip(1).filter_map(|rest| rest.split("```").next()).collect()
}

/// Returns whether Python has these modules.
fn has(modules: &str) -> bool {
    let ran = Command::new("python3").args(["-c", &format!("import {modules}")]).output();
    ran.is_ok_and(|ran| ran.status.success())
}

#[test]
fn the_recipes_for_python_run() {
    if !has("json") {
        return;
    }
    let page = std::fs::read_to_string(root().join("docs/python.md")).unwrap();
    let blocks = blocks(&page);
    assert_eq!(blocks.len(), 5);
    let arrays = has("numpy, OpenEXR");
    let script: Vec<&str> =
        blocks.into_iter().filter(|block| arrays || !block.contains("import OpenEXR")).collect();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("recipes.py"), script.join("\n")).unwrap();
    let ran = Command::new("python3")
        .arg("recipes.py")
        .current_dir(folder.path())
        .env("PATH", support::path_with_programs())
        .output()
        .unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let said = String::from_utf8_lossy(&ran.stdout);
    assert!(said.contains("triangles") && said.contains("root mean square error"), "{said}");
    for name in ["knot.png", "vase-turn-0.png", "vase-turn-1.png", "vase-turn-2.png"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
}
