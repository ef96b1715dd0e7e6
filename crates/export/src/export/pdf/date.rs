//! Dates of documents.

/// A moment as seconds since 1970 began in Greenwich, until the end of the year 9999.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timestamp {
    seconds: u64,
}

const SECONDS_A_DAY: u64 = 86_400;
/// The first second of the year 10000.
const END: u64 = 253_402_300_800;

impl Timestamp {
    /// Takes seconds since 1970; none for moments after the year 9999.
    pub fn of_unix(seconds: u64) -> Option<Self> {
        (seconds < END).then_some(Self { seconds })
    }

    /// As PDF writes it: `D:20261121080000Z`.
    pub(super) fn to_pdf(self) -> String {
        let (year, month, day) = civil(self.seconds / SECONDS_A_DAY);
        let second = self.seconds % SECONDS_A_DAY;
        let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
        format!("D:{year:04}{month:02}{day:02}{hour:02}{minute:02}{second:02}Z")
    }
}

/// Year, month and day of the Gregorian calendar, `days` after 1 January 1970 (Howard Hinnant,
/// `chrono`-Compatible Low-Level Date Algorithms, `civil_from_days`).
fn civil(days: u64) -> (u64, u64, u64) {
    let days = days + 719_468;
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    (year_of_era + era * 400 + u64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_moments() {
        // By `date -u -d @N +%Y%m%d%H%M%S`.
        for (seconds, text) in [
            (0, "D:19700101000000Z"),
            (951_782_400, "D:20000229000000Z"),
            (1_000_000_000, "D:20010909014640Z"),
            (4_107_542_399, "D:21000228235959Z"),
            (4_107_542_400, "D:21000301000000Z"),
            (END - 1, "D:99991231235959Z"),
        ] {
            assert_eq!(Timestamp::of_unix(seconds).map(Timestamp::to_pdf).as_deref(), Some(text));
        }
        assert_eq!(Timestamp::of_unix(END), None);
    }
}
