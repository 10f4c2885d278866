//! The animation as MP4 or GIF, with ffmpeg.

use crate::args::FilmFormat;
use anyhow::{Context, bail};
use motiform_lab::draw::Picture;
use std::process::{Command, Stdio};

/// The animation that [`motiform_lab::draw::draw`] makes.
const ANIMATION: &str = "motion.png";

/// Checks that ffmpeg is installed if a video is requested; called before anything is computed.
pub(crate) fn check(formats: &[FilmFormat]) -> anyhow::Result<()> {
    if formats.is_empty() {
        return Ok(());
    }
    let version = Command::new("ffmpeg").arg("-version").stdin(Stdio::null()).output();
    match version {
        Ok(output) if output.status.success() => Ok(()),
        _ => bail!(
            "--film needs ffmpeg, which does not start: install it (Debian: apt-get install ffmpeg), or omit --film and open \
             {ANIMATION} in a browser"
        ),
    }
}

/// The animation among the pictures as videos; nothing if there is none.
pub(crate) fn convert(pictures: &[Picture], formats: &[FilmFormat]) -> anyhow::Result<Vec<Picture>> {
    let animation = pictures.iter().find(|picture| picture.name == ANIMATION);
    let film = |animation| formats.iter().map(move |format| encode(animation, *format));
    animation.into_iter().flat_map(film).collect()
}

/// Converts an animated PNG to a video.
fn encode(animation: &Picture, format: FilmFormat) -> anyhow::Result<Picture> {
    let (ending, arguments): (_, &[&str]) = match format {
        // players want even sides and this pixel format
        FilmFormat::Mp4 => (
            "mp4",
            &[
                "-vf",
                "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
                "-c:v",
                "libx264",
                "-crf",
                "18",
                "-pix_fmt",
                "yuv420p",
                "-movflags",
                "+faststart",
            ],
        ),
        FilmFormat::Gif => (
            "gif",
            &[
                "-vf",
                "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none",
                "-loop",
                "0",
            ],
        ),
    };
    let folder = tempfile::tempdir().context("no folder for temporary files")?;
    let (from, name) = (folder.path().join(ANIMATION), format!("motion.{ending}"));
    let to = folder.path().join(&name);
    std::fs::write(&from, &animation.bytes).with_context(|| format!("cannot write {}", from.display()))?;
    let mut command = Command::new("ffmpeg");
    command.args(["-nostdin", "-loglevel", "error", "-y", "-i"]).arg(&from).args(arguments).arg(&to);
    let output = command.output().context("ffmpeg does not start")?;
    if !output.status.success() {
        bail!("ffmpeg cannot write {name}: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    let bytes = std::fs::read(&to).with_context(|| format!("cannot read {}", to.display()))?;
    Ok(Picture { name, bytes })
}
