//! Enums whose variants have names: declared once, with their documentation.

/// Words that are no names of tables and options with spaces for hyphens.
const WRITTEN: [&str; 7] =
    ["quasi-periodic", "blow-up", "Hopf", "zero-Hopf", "double Hopf", "Bogdanov-Takens", "Bautin"];

/// A name of tables and options as people write it: `pulsating straight` for `pulsating-straight`, `zero-Hopf` for `zero-hopf`.
pub fn in_words(name: &str) -> String {
    let known = WRITTEN.into_iter().find(|known| known.to_lowercase().replace(' ', "-") == name);
    known.map_or_else(|| name.replace('-', " "), str::to_owned)
}

/// Declares an enum with a text for each variant, `Variant = "text"`, and the method that gives it: `enum Motion by name { ... }`.
/// It has all variants in their order (`ALL`), is found by a text, and displayed as it.
///
/// ```
/// motiform_dynamics::named! {
///     /// A side.
///     #[derive(Clone, Copy, Debug, PartialEq)]
///     pub enum Side by name {
///         /// Of the heart.
///         Left = "left",
///         /// The other one.
///         Right = "right",
///     }
/// }
/// assert_eq!(Side::ALL.map(Side::name), ["left", "right"]);
/// assert_eq!(Side::find("right"), Some(Side::Right));
/// ```
#[macro_export]
macro_rules! named {
    ($(#[$about:meta])* pub enum $Type:ident by $text:ident {
        $($(#[$meaning:meta])* $Variant:ident = $name:literal,)*
    }) => {
        $(#[$about])*
        pub enum $Type { $($(#[$meaning])* $Variant,)* }

        impl $Type {
            /// All of them, in their order.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$Variant),*];

            #[doc = concat!("Its ", stringify!($text), ".")]
            pub const fn $text(self) -> &'static str {
                match self { $(Self::$Variant => $name,)* }
            }

            #[doc = concat!("The one of this ", stringify!($text), ".")]
            pub fn find(text: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|one| one.$text() == text)
            }
        }

        impl std::fmt::Display for $Type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.$text())
            }
        }
    };
}
