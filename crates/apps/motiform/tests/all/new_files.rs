//! `new` and `doctor`.

use crate::common::Folder;
use std::fs;

/// A file of `new` is a study that runs; a file that is there stays as it is.
#[test]
fn new_files_run_and_replace_nothing() {
    let folder = Folder::new();
    for (name, options) in [("study.toml", ""), ("equations.toml", "--equations")] {
        folder.run(&format!("new {name} {options}")).expect(0);
        let text = fs::read_to_string(folder.path(name)).expect("a file");
        folder.run(&format!("check {name}")).expect(0);
        let verdict = folder.run(&format!("classify {name} --json")).json();
        assert_eq!(verdict["regime"], "zigzag", "{name}");
        let again = folder.run(&format!("new {name}")).expect(2);
        assert!(again.stderr.contains("it exists and stays"), "{}", again.stderr);
        assert_eq!(fs::read_to_string(folder.path(name)).expect("a file"), text);
    }
    let done = folder.run("new study").expect(2);
    assert!(done.stderr.contains("ends in .toml"), "{}", done.stderr);
}

#[test]
fn doctor_says_what_is_there() {
    let found = Folder::new().run("doctor --json").json();
    assert!(found["lanes"].as_u64().is_some_and(|lanes| [1, 4, 8].contains(&lanes)), "{found}");
    assert!(found["motions_per_second"]["one_thread"].as_f64().is_some_and(|rate| rate > 0.0), "{found}");
    let text = Folder::new().run("doctor").expect(0).stdout;
    assert!(text.contains("motions named a second") && text.contains("ffmpeg"), "{text}");
}

#[test]
fn models_takes_a_preset_and_figure_says_what_it_cannot_draw() {
    let folder = Folder::new();
    let of_preset = folder.run("models fig5a").expect(0).stdout;
    let of_model = folder.run("models tensor").expect(0).stdout;
    let values =
        of_preset.strip_prefix(of_model.trim_end()).expect("the model's page, and the preset's values");
    assert!(values.contains("The preset fig5a") && values.contains("kappa2=0.9"), "{values}");
    assert_eq!(of_preset, folder.run("models tensor --preset fig5a").expect(0).stdout);
    assert!(folder.run("models cell --preset fig5a").expect(2).stderr.contains("fig6a"));
    folder.run("statistics tensor --preset fig5a --bodies 8 --t-end 20 --transient 0 --noise 0.1 --out many");
    let done = folder.run("figure many").expect(2);
    assert!(done.stderr.contains("many") && done.stderr.contains("not drawn again"), "{}", done.stderr);
}
