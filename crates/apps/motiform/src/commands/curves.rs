//! `motiform continue --curve`.

use super::continuation::{end, or_abandon, output, prepare, write};
use crate::args::ContinueOptions;
use crate::output::{End, plain, print, warn};
use crate::progress::Progress;
use motiform_diagrams::curves::{
    CurveFolder, FollowedCurve, codimension_2, curve_ends, curve_summary, follow_curves_kept, not_found,
};
use motiform_diagrams::draw::{check_scan, curve_figures};
use motiform_lab::scan::ScanFolder;
use motiform_study::CurvePlan;
use std::fmt::Write;

pub(crate) fn run(options: &ContinueOptions, plan: &CurvePlan) -> anyhow::Result<End> {
    let over = options.over.as_deref().map(ScanFolder::read).transpose()?;
    if let Some(folder) = &over {
        check_scan(plan, folder.plan())?;
    }
    let out = output(options, plan.default_folder());
    let (files, before) = prepare(options, out, |path, opening| CurveFolder::open(path, plan, opening))?;
    let watch = Progress::new(1.0, "of branches and curves");
    let mut keep = |found: &_| files.as_ref().map_or(Ok(()), |folder| CurveFolder::keep(found, folder));
    let found = follow_curves_kept(plan, before, &mut keep, &watch);
    watch.finish();
    let (files, found) = or_abandon(files, found)?;
    let folder = CurveFolder { plan: plan.clone(), found };
    let drawn = || curve_figures(&folder.plan, &folder.found, over.as_ref());
    let (written, undrawn) = write(options, files, drawn, |pictures, to| folder.write(pictures, to))?;
    if folder.found.complete && folder.found.curves.is_empty() {
        warn(
            "no special point of these kinds lies on the branches that were followed; --branches N follows more",
        );
    }
    print(&if options.json {
        serde_json::to_string(&curve_summary(&folder.plan, &folder.found))?
    } else {
        text(&folder, written.as_deref())?
    })?;
    end(undrawn, folder.found.complete)
}

fn text(folder: &CurveFolder, written: Option<&str>) -> anyhow::Result<String> {
    let CurveFolder { plan, found } = folder;
    let mut text = plain(&plan.title());
    for side in &plan.computation.plane {
        write!(text, ", {side}")?;
    }
    writeln!(text, "\n{} branches along {}", found.branches.branches.len(), plan.computation.branches.along)?;
    for (number, followed) in found.curves.iter().enumerate() {
        curve(&mut text, folder, (number, followed))?;
    }
    if let Some(written) = written {
        writeln!(text, "written    {written}")?;
    }
    Ok(text.trim_end().to_owned())
}

fn curve(
    text: &mut String,
    CurveFolder { plan, found }: &CurveFolder,
    (number, followed): (usize, &FollowedCurve),
) -> std::fmt::Result {
    let [across, upwards] = plan.computation.plane.each_ref().map(|side| side.name.as_str());
    let [x, y] = found.start(plan, followed).unwrap_or([f64::NAN; 2]);
    let (kind, points) = (followed.kind.name(), followed.samples().count());
    writeln!(
        text,
        "curve {number:<4} {kind} through {across} = {x:.9}, {upwards} = {y:.9}, {points} points"
    )?;
    if let Some(why) = &followed.refused {
        writeln!(text, "           not followed: {why}")?;
    }
    for (kind, sample) in codimension_2(followed) {
        let [x, y] = sample.parameters;
        writeln!(text, "           {:<17} {across} = {x:.9}  {upwards} = {y:.9}", kind.name())?;
    }
    let missing: Vec<&str> = not_found(followed).iter().map(|kind| kind.name()).collect();
    if !missing.is_empty() {
        writeln!(text, "           none found of {}", missing.join(", "))?;
    }
    for end in curve_ends(plan, followed) {
        writeln!(text, "           ends: {end}")?;
    }
    Ok(())
}
