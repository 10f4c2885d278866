//! The page, built into the program.

/// A file of the page.
pub(crate) struct Asset {
    name: &'static str,
    pub(crate) kind: &'static str,
    pub(crate) content: &'static [u8],
}

/// All files; the page is built from `web/` by `npm run build`, and CI checks this.
const ASSETS: [Asset; 4] = [
    Asset { name: "", kind: "text/html; charset=utf-8", content: include_bytes!("../../page/index.html") },
    Asset {
        name: "app.js",
        kind: "text/javascript; charset=utf-8",
        content: include_bytes!("../../page/app.js"),
    },
    Asset { name: "app.css", kind: "text/css; charset=utf-8", content: include_bytes!("../../page/app.css") },
    Asset { name: "icon.svg", kind: "image/svg+xml", content: include_bytes!("../../page/icon.svg") },
];

/// The file of this name; the empty name is the page itself.
pub(crate) fn asset(name: &str) -> Option<&'static Asset> {
    ASSETS.iter().find(|asset| asset.name == name)
}
