//! `motiform explore`.

use crate::args::ExploreOptions;
use crate::interrupt::on_interrupt;
use crate::output::{End, print, warn};
use motiform_cells::{RecordedFrame, recorded};
use motiform_explorer::server::{Handover, Options, Server};
use motiform_explorer::{StudyFile, TrackedCell};
use motiform_models::ModelInfo;
use motiform_models::amplitudes::NAME;
use motiform_store::{Kind, kind_of};
use motiform_study::presets::{EXTENSIONS, PRESETS, Preset};
use std::path::Path;
use std::process::{Command, Stdio};

pub(crate) fn run(options: &ExploreOptions) -> anyhow::Result<End> {
    let server = Server::bind(&settings(options)?)?;
    let address = server.address();
    print(&format!("the explorer is running at\n  {address}\non this machine only; Ctrl-C stops it"))?;
    let handle = server.handle();
    on_interrupt(move || handle.stop());
    let handover = if options.no_open { None } else { open(&address) };
    if !options.no_open && handover.is_none() {
        warn("no browser could be opened: open the address above");
    }
    server.run();
    drop(handover); // the file stays while its browser may still read it
    Ok(End::Done)
}

/// The settings of the server; model, file and preset are checked here.
fn settings(options: &ExploreOptions) -> anyhow::Result<Options> {
    let ExploreOptions { subject, preset, port, token, .. } = options;
    let mut settings = Options { port: *port, token: token.clone(), ..Options::default() };
    if let Some(path) = subject.as_ref().filter(|name| name.ends_with(".toml")) {
        if let Some(name) = preset {
            anyhow::bail!(
                "--preset {name}: a study file sets its own preset: write preset = \"...\" in the file"
            );
        }
        settings.file = Some(study_file(Path::new(path))?);
        return Ok(settings);
    }
    if let Some(folder) = subject.as_ref().filter(|name| is_fit(Path::new(name))) {
        let files = study_files(Path::new(folder))?;
        anyhow::bail!("{folder} is a folder of results; give a study file in it: {}", files.join(", "));
    }
    if let Some(name) = preset {
        let (Some(found), model) = (known(name), subject.as_deref()) else {
            let all: Vec<&str> = PRESETS.iter().chain(EXTENSIONS).map(|preset| preset.name).collect();
            anyhow::bail!("--preset {name}: unknown preset; give one of {}", all.join(", "));
        };
        if let Some(model) = model.filter(|model| *model != found.model) {
            anyhow::bail!("--preset {name}: a preset of the model {}, not of {model}", found.model);
        }
        // An extension is a model of its own on the page.
        let own = found.model == NAME;
        (settings.preset, settings.model) =
            if own { (None, Some(name.clone())) } else { (Some(name.clone()), None) };
    } else if let Some(name) = subject {
        let extension = EXTENSIONS.iter().any(|preset| preset.name == name);
        if !extension {
            ModelInfo::find(name)?;
        }
        settings.model = Some(name.clone());
    }
    Ok(settings)
}

/// A study file, with the tracked cell that it was fitted to if `motiform fit` wrote it.
fn study_file(path: &Path) -> anyhow::Result<StudyFile> {
    let mut file = StudyFile::read(path)?;
    file.tracked = recorded(path)?.map(|cell| TrackedCell {
        name: cell.name,
        units: cell.units,
        frames: cell.frames.into_iter().map(numbers).collect(),
    });
    Ok(file)
}

/// The study files in a folder of fits.
fn study_files(folder: &Path) -> anyhow::Result<Vec<String>> {
    let mut files = Vec::new();
    for entry in folder.read_dir()? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            files.push(path.display().to_string());
        }
    }
    files.sort_unstable();
    if files.is_empty() {
        files.push("none of its cells has equations".to_owned());
    }
    Ok(files)
}

/// Time, centre, radius, modes.
fn numbers(frame: RecordedFrame) -> Vec<f64> {
    let RecordedFrame { t, centre, radius, z } = frame;
    [t, centre[0], centre[1], radius].into_iter().chain(z.into_iter().flatten()).collect()
}

/// A preset of the paper, or an extension.
fn known(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().chain(EXTENSIONS).find(|preset| preset.name == name)
}

/// Opens an address in the browser, through a file: the arguments of a program can be read by everybody on the machine. `None` where
/// this was not possible.
fn open(address: &str) -> Option<Handover> {
    let handover = Handover::new(address).ok()?;
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command
        .args(arguments)
        .arg(handover.path())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let mut child = command.spawn().ok()?;
    // The child is waited for, so that it leaves no zombie; if it fails, the printed address remains.
    std::thread::spawn(move || child.wait());
    Some(handover)
}

/// `true` if a folder was written by `motiform fit` or `motiform observe`.
fn is_fit(folder: &Path) -> bool {
    matches!(kind_of(folder), Some(Kind::Fits | Kind::Observations))
}
