//! Messages of a page: the damaged ones of the fuzz tests are made from them.
#![allow(unreachable_pub, reason = "shared by tests of several crates")]

pub const MESSAGES: [&str; 12] = [
    r#"{"do":"begin","model":"tensor","preset":"fig5a"}"#,
    r#"{"do":"begin","model":"cell","preset":"fig6a","parameters":{"length":21.0},"noise":0.001,"seed":3}"#,
    r#"{"do":"set","parameters":{"kappa2":0.5,"kappa3":0.1}}"#,
    r#"{"do":"noise","amplitude":0.05}"#,
    r#"{"do":"kick"}"#,
    r#"{"do":"advance","dt":0.5}"#,
    r#"{"do":"strips","section":"path","y":0.5}"#,
    r#"{"do":"map","epoch":1,"x":{"name":"kappa2","low":-0.2,"high":0.2},"y":{"name":"gamma","low":-0.1,"high":0.1},"count":9}"#,
    r#"{"do":"evidence","epoch":1,"cell":[1,1]}"#,
    r#"{"do":"share"}"#,
    r#"{"do":"follow","epoch":1,"along":{"name":"kappa2","low":0.3,"high":1.6},"branches":2}"#,
    r#"{"do":"place","epoch":1,"branch":0,"point":3}"#,
];
