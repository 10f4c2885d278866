//! Sizes of statistical samples in tests: small ones in a push, whole ones on demand.

/// `pushed`, or `whole` where the variable MOTIFORM_SAMPLES is set (`cargo xtask samples`): a number of draws, or a limit that goes with
/// it.
///
/// Limits of both forms follow from their numbers of draws. Seeds are fixed: what passes once passes until the program changes, and a
/// change that alters the draws alone fails a push in at most one of a thousand cases.
pub(crate) fn draws<T>(pushed: T, whole: T) -> T {
    if std::env::var_os("MOTIFORM_SAMPLES").is_some() { whole } else { pushed }
}
