//! The views for a count and a band.

use super::packing::{Effort, pack};
use super::table;
use super::{Band, ViewSet, ViewsError};

/// Largest number of views a set may have.
pub const MAX_VIEWS: usize = 200;

/// `n` directions in `band` as far apart as we can place them (Tammes problem, paper section "View
/// configuration"), of which `directions[0]` is the top view: the pole, or azimuth 0 at the band's
/// highest elevation where that is below the pole.
///
/// The band is closed: views may stand on its rim. The default band comes from the committed
/// table, others from the generator (about a second at a hundred views).
///
/// # Errors
/// `n` outside `1..=MAX_VIEWS`; a band that is none.
pub fn tammes(n: usize, band: Band) -> Result<ViewSet, ViewsError> {
    if !(1..=MAX_VIEWS).contains(&n) {
        return Err(ViewsError::Count { count: n, min: 1, max: MAX_VIEWS });
    }
    band.validate()?;
    if band == Band::DEFAULT
        && let Some(directions) = table::look_up(n)
    {
        return Ok(ViewSet::from_directions(directions));
    }
    Ok(ViewSet::from_directions(pack(n, band, Effort::INTERACTIVE)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(10))]

        #[test]
        fn every_set_keeps_to_its_band_and_starts_at_its_top(
            n in 1usize..11, low in -60.0..60.0f64, width in 1.0..30.0f64,
        ) {
            let band = Band::from_degrees(low, low + width).unwrap();
            let set = tammes(n, band).unwrap();
            prop_assert_eq!(set.directions.len(), n);
            prop_assert!(set.directions.iter().all(|direction| band.contains(direction, 1e-9)));
            prop_assert!((set.directions[0].z - band.max_elevation_rad.sin()).abs() < 1e-9);
            prop_assert!((set.separation_rad - crate::views::separation_rad(&set.directions)).abs() < 1e-12);
            prop_assert_eq!(&set, &tammes(n, band).unwrap());
        }
    }

    #[test]
    fn counts_out_of_range_are_refused_with_the_range() {
        for count in [0, 201] {
            let expected = ViewsError::Count { count, min: 1, max: 200 };
            assert_eq!(tammes(count, Band::DEFAULT), Err(expected));
        }
    }
}
