//! Results that are computed once, though several chapters ask for them.

use motiform_study::Error;
use std::any::Any;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// A result of any type.
type Anything = Arc<dyn Any + Send + Sync>;

/// The place of a result; locked while it is computed.
type Place = Arc<Mutex<Option<Anything>>>;

/// Results by what they are of.
#[derive(Default)]
pub struct Kept(Mutex<HashMap<String, Place>>);

impl Kept {
    /// The result of this name, computed where it is not there yet. Others that ask for it wait.
    ///
    /// # Errors
    /// Those of the computation, of which nothing is kept.
    pub fn once<T: Clone + Send + Sync + 'static>(
        &self,
        name: &str,
        compute: impl FnOnce() -> Result<T, Error>,
    ) -> Result<T, Error> {
        let mut compute = Some(compute);
        let found = self.any(name, &mut || {
            // called at most once
            let compute = compute.take().ok_or(Error::Interrupted)?;
            Ok(Arc::new(compute()?))
        })?;
        found.downcast_ref::<T>().cloned().ok_or(Error::Interrupted)
    }

    /// The same for results of any type: compiled once.
    fn any(
        &self,
        name: &str,
        compute: &mut dyn FnMut() -> Result<Anything, Error>,
    ) -> Result<Anything, Error> {
        let place = {
            let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            Arc::clone(all.entry(name.to_owned()).or_default())
        };
        let mut there = place.lock().unwrap_or_else(PoisonError::into_inner);
        if there.is_none() {
            *there = Some(compute()?);
        }
        there.clone().ok_or(Error::Interrupted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_computed_once_and_an_error_is_not_kept() {
        let kept = Kept::default();
        let refused = || Err::<u32, _>(Error::Interrupted);
        assert!(kept.once("one", refused).is_err());
        assert_eq!(kept.once("one", || Ok(1_u32)).ok(), Some(1));
        assert_eq!(kept.once("one", || Ok(2_u32)).ok(), Some(1));
        assert_eq!(kept.once("two", || Ok(2_u32)).ok(), Some(2));
    }
}
