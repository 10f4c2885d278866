//! The same orbits with the tensor model given as text: a list of products in lanes; and with all terms of the built-in model.

use crate::options::Options;
use crate::orbits::{Failure, Field, members_between, propagated};
use motiform_models::Parameters;
use motiform_models::amplitudes::{Amplitudes, AmplitudesField, Definition, ParameterDefinition, info};
use motiform_models::tensor::TensorParameters;
use motiform_models::tensor::fourier::{FourierField, terms};
use serde_json::Value;
use std::time::Instant;

/// The terms of the paper's full model.
const PAPER: [&str; 3] = [
    "(gamma - |z1|^2)*z1 - 2*a1*conj(z1)*z2",
    "-kappa2*z2 + b1/4*z1^2 + b2*conj(z1)*z3",
    "-kappa3*z3 + d1/8*z1^3 + d2/2*z1*z2",
];

/// All terms of the tensor model: (Z1), (Z2), (Z3).
const ALL: [&str; 3] = [
    "(gamma - |z1|^2 - 8*a4*|z2|^2 - 16*a5*|z3|^2)*z1 - 2*a1*conj(z1)*z2 - 2*a2*conj(z1)^2*z3 - 8*a3*conj(z2)*z3 + 16*a6*conj(z3)*z2^2",
    "(-kappa2 - b4*|z1|^2 - 8*b3*|z2|^2 - 16*b5*|z3|^2)*z2 + b1/4*z1^2 + b2*conj(z1)*z3 + 2*b6*z1*conj(z2)*z3",
    "(-kappa3 - d4*|z1|^2 - 8*d5*|z2|^2 - 16*d3*|z3|^2)*z3 + d1/8*z1^3 + d2/2*z1*z2 + 2*d6*conj(z1)*z2^2",
];

fn fields(
    texts: [&str; 3],
    members: &[(TensorParameters, [f64; 6])],
) -> Result<Vec<(AmplitudesField<f64, 6>, [f64; 6])>, Failure> {
    let specs = TensorParameters::specs();
    let equations = texts.map(str::to_owned).to_vec();
    let parameters = specs.iter().map(|spec| ParameterDefinition::new(spec.name, spec.default)).collect();
    let definition = Definition {
        modes: vec![1, 2, 3],
        velocity: None,
        symmetry: None,
        parameters,
        equations,
        noise: std::collections::BTreeMap::new(),
    };
    let info = info(&definition)?;
    let field = |p: &TensorParameters| {
        let body = info.build(&p.values()).ok()?;
        body.as_any()?.downcast_ref::<Amplitudes>()?.field()
    };
    members.iter().map(|(p, start)| Ok((field(p).ok_or("no amplitude equations")?, *start))).collect()
}

/// `terms=paper` or `terms=all`; `form=text` or `form=built-in`; `setup=counted` times the reading of the text as well.
pub fn amplitudes(options: &Options) -> Result<Value, Failure> {
    let members = members_between(options.get("members", 64)?, (0.45, 0.65));
    let paper = options.get("terms", "paper".to_owned())? == "paper";
    if options.get("form", "text".to_owned())? == "built-in" {
        if paper {
            let some: Vec<_> = members.into_iter().map(|(_, field, start)| (field, start)).collect();
            return propagated(options, false, &some);
        }
        let all = |(_, field, start): &(_, Field, _)| (FourierField::<f64, { terms::ALL }>(field.0), *start);
        return propagated(options, false, &members.iter().map(all).collect::<Vec<_>>());
    }
    let members: Vec<_> = members.iter().map(|(p, _, start)| (*p, *start)).collect();
    let clock = Instant::now();
    let fields = fields(if paper { PAPER } else { ALL }, &members)?;
    let setup = clock.elapsed().as_secs_f64();
    let mut result = propagated(options, false, &fields)?;
    if options.get("setup", String::new())? == "counted" {
        let seconds = result["seconds"].as_f64().unwrap_or(f64::NAN);
        result["seconds"] = (seconds + setup).into();
    }
    Ok(result)
}
