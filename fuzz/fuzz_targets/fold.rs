//! FOLD masters, as `tatamu check` reads them.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tatamu::check;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(report) = check::fold(bytes) {
        let _ = report.is_sound(1e-6);
    }
});
