//! `motiform continue --curve`.

use super::continuation::{end, or_abandon, output, prepare, write};
use crate::args::ContinueOptions;
use crate::output::{End, plain, say, warn};
use crate::progress::Progress;
use motiform_diagrams::Sample;
use motiform_diagrams::curves::{
    CurveFolder, FollowedCurve, codimension_2, curve_ends, curve_summary, follow_curves_kept, not_found,
};
use motiform_diagrams::draw::{check_scan, curve_figures};
use motiform_dynamics::in_words;
use motiform_lab::scan::ScanFolder;
use motiform_study::curves::CurveKind;
use motiform_study::{CurvePlan, counted};
use serde::{Serialize, Serializer};
use std::fmt::{Display, Formatter};

pub(crate) fn run(options: &ContinueOptions, plan: &CurvePlan) -> anyhow::Result<End> {
    let over = options.over.as_deref().map(ScanFolder::read).transpose()?;
    if let Some(folder) = &over {
        check_scan(plan, folder.plan())?;
    }
    let out = output(options, plan.default_folder());
    let (files, before) = prepare(options, out, |path, opening| CurveFolder::open(path, plan, opening))?;
    let watch = Progress::of_stage("branches and curves", "of those known so far");
    let mut keep = |found: &_| files.as_ref().map_or(Ok(()), |folder| CurveFolder::keep(found, folder));
    let found = watch.over(|watch| follow_curves_kept(plan, before, &mut keep, watch));
    let (files, found) = or_abandon(files, found)?;
    let folder = CurveFolder { plan: plan.clone(), found };
    let drawn = || curve_figures(&folder.plan, &folder.found, over.as_ref());
    let (written, undrawn) = write(options, files, drawn, |pictures, to| folder.write(pictures, to))?;
    let crosses = |followed: &motiform_diagrams::Followed| {
        let crosses = |sample: &Sample| sample.point.special.is_some_and(|one| one.name() == "branch-point");
        followed.samples().any(crosses)
    };
    if plan.computation.kinds.contains(&CurveKind::Pitchfork)
        && folder.found.branches.branches.iter().any(crosses)
    {
        warn(
            "branches cross without a symmetry that the model states: such points, pitchforks among them, are not followed over two \
             parameters (symmetry = \"mirror\" states one)",
        );
    } else if folder.found.complete && folder.found.curves.is_empty() {
        warn(
            "no special point of these kinds lies on the branches that were followed; --branches N follows more",
        );
    }
    say(&Followed { folder: &folder, written: written.as_deref() }, options.json)?;
    end(undrawn, folder.found.complete)
}

/// The curves of a plan.
struct Followed<'a> {
    folder: &'a CurveFolder,
    written: Option<&'a str>,
}

impl Serialize for Followed<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        curve_summary(&self.folder.plan, &self.folder.found).serialize(serializer)
    }
}

impl Display for Followed<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let CurveFolder { plan, found } = self.folder;
        f.write_str(&plain(&plan.title()))?;
        for side in &plan.computation.plane {
            write!(f, ", {}", side.words())?;
        }
        let branches = counted(found.branches.branches.len(), "branch");
        write!(f, "\n{branches} along {}", plan.computation.branches.along.words())?;
        for (number, followed) in found.curves.iter().enumerate() {
            curve(f, self.folder, number, followed)?;
        }
        self.written.map_or(Ok(()), |written| write!(f, "\nwritten    {written}"))
    }
}

fn curve(
    f: &mut Formatter<'_>,
    CurveFolder { plan, found }: &CurveFolder,
    number: usize,
    followed: &FollowedCurve,
) -> std::fmt::Result {
    let [across, upwards] = plan.computation.plane.each_ref().map(|side| side.name.as_str());
    let [x, y] = found.start(plan, followed).unwrap_or([f64::NAN; 2]);
    let (kind, points) = (in_words(followed.kind.name()), followed.samples().count());
    write!(f, "\ncurve {number:<4} {kind} through {across} = {x:.9}, {upwards} = {y:.9}, {points} points")?;
    if let Some(why) = &followed.refused {
        write!(f, "\n           not followed: {why}")?;
    }
    for (kind, sample) in codimension_2(followed) {
        let [x, y] = sample.parameters;
        write!(f, "\n           {:<17} {across} = {x:.9}  {upwards} = {y:.9}", in_words(kind.name()))?;
    }
    let missing: Vec<String> = not_found(followed).iter().map(|kind| in_words(kind.name())).collect();
    if !missing.is_empty() {
        write!(f, "\n           none found of {}", missing.join(", "))?;
    }
    for end in curve_ends(plan, followed) {
        write!(f, "\n           ends: {end}")?;
    }
    Ok(())
}
