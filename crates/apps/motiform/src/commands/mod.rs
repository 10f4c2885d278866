//! One file per command; `args` lists them.

pub(crate) mod atlas;
pub(crate) mod check;
pub(crate) mod classify;
pub(crate) mod completions;
pub(crate) mod continuation;
mod curves;
pub(crate) mod doctor;
pub(crate) mod equilibria;
#[cfg(feature = "explorer")]
pub(crate) mod explore;
pub(crate) mod figure;
mod film;
pub(crate) mod fit;
pub(crate) mod lifetimes;
pub(crate) mod lyapunov;
pub(crate) mod merge;
pub(crate) mod models;
pub(crate) mod new;
pub(crate) mod observe;
mod pages;
mod population;
mod remarks;
pub(crate) mod reproduce;
pub(crate) mod scan;
pub(crate) mod section;
pub(crate) mod simulate;
pub(crate) mod statistics;
mod subject;
pub(crate) mod verify;
