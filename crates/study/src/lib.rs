//! Studies: from study file to plan to dataset to figure.

pub mod figures;
