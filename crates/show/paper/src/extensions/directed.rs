//! Bodies in a field: speeds and directions that can be computed by hand.

use super::verdict;
use crate::claims::check;
use crate::context::Context;
use motiform_analysis::regime::Course;
use motiform_figures::report::Claim;
use motiform_study::Error;

pub(super) fn claims(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    let mut claims = vec![falling(context)?];
    claims.extend(stretched(context)?);
    Ok(claims)
}

/// Along the force: gamma v - (1 + a1 b1/(2 kappa2)) v^3 + g = 0.
fn falling(context: &Context<'_>) -> Result<Claim, Error> {
    let (a1, b1, kappa2) = (-1.0, -0.5, 0.5);
    let cubic = 1.0 + a1 * b1 / (2.0 * kappa2);
    let mut worst = 0.0_f64;
    let mut along = true;
    let mut speeds = Vec::new();
    for (gamma, g) in [(-1.0, 0.1), (-0.5, 0.4), (0.3, 0.1)] {
        let verdict = verdict(context, "force", &[("gamma", gamma), ("g", g)])?;
        let speed = verdict.speed.map_or(f64::NAN, |speed| speed.mean);
        worst = worst.max((gamma * speed - cubic * speed * speed * speed + g).abs());
        along &= verdict.course == Some(Course::AlongField);
        speeds.push(format!("{speed:.6}"));
    }
    let says = "Under a constant force *g* along *x* the body moves along the force at the speed that solves \
                *γ* *v* − (1 + *a*_1 *b*_1/2*κ*_2) *v*^3 + *g* = 0.";
    let finds = format!(
        "along the force each time, at {}; the cubic is zero there within {worst:.1e}",
        speeds.join(", ")
    );
    let how = "(*γ*, *g*) = (−1, 0.1), (−0.5, 0.4), (0.3, 0.1) from a small random start; within 10^{-9}";
    Ok(check(says, finds, how, along && worst < 1e-9))
}

/// Along the field for a1 < 0, across it for a1 > 0: `v^2 = gamma + |a1| E^2/(2 kappa2)`, for b1 = 0.
fn stretched(context: &Context<'_>) -> Result<[Claim; 2], Error> {
    let (gamma, kappa2, field) = (0.5, 0.5, 0.8);
    let mut worst = 0.0_f64;
    let mut courses = Vec::new();
    for a1 in [-0.5, -0.2, 0.2, 0.5_f64] {
        let verdict = verdict(context, "elongating-field", &[("a1", a1)])?;
        let speed = verdict.speed.map_or(f64::NAN, |speed| speed.mean);
        worst = worst.max((speed * speed - gamma - a1.abs() * field * field / (2.0 * kappa2)).abs());
        courses.push(verdict.course);
    }
    let names: Vec<&str> = courses.iter().map(|course| course.map_or("none", Course::name)).collect();
    let (along, across) = (Some(Course::AlongField), Some(Course::AcrossField));
    let says =
        "A body that a field stretches moves along the field for *a*_1 < 0 and across it for *a*_1 > 0.";
    let finds = format!("*a*_1 = −0.5, −0.2, 0.2, 0.5: {}", names.join(", "));
    let how = "the direction of the velocity, within 10^{-6} rad of the axes";
    let holds = courses[..2].iter().all(|course| *course == along)
        && courses[2..].iter().all(|course| *course == across);
    let first = check(says, finds, how, holds);
    let says = "Its speed is *v*^2 = *γ* + |*a*_1| *E*^2/2*κ*_2.";
    let finds = format!("the squares differ from the formula by at most {worst:.1e}");
    Ok([first, check(says, finds, "*b*_1 = 0; within 10^{-9}", worst < 1e-9)])
}
