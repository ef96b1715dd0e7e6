//! What the numbers of GRBL mean, in short; see doc/csv in github.com/gnea/grbl.

/// Why a line was refused.
pub fn rejected(code: u16) -> &'static str {
    match code {
        1 | 2 | 23..=36 => "the line is not G-code that it reads",
        5 => "homing is not switched on",
        8 => "it is not idle",
        9 => "it is locked",
        11 => "the line is too long",
        13 => "its door is open",
        15 => "it is beyond its travel",
        20 | 21 => "it does not know the command",
        22 => "no speed is set",
        _ => "see the list of GRBL",
    }
}

/// Why it is in alarm.
pub fn alarm(code: u16) -> &'static str {
    match code {
        1 => "a limit switch was hit",
        2 => "the job goes beyond its travel",
        3 => "it was reset while it moved",
        6..=10 => "homing failed",
        _ => "see the list of GRBL",
    }
}

/// What goes wrong with a wrong setting.
pub fn setting(number: u16) -> &'static str {
    match number {
        30 => "S would mean another power than meant",
        32 => "laser mode is not as the tool needs it, and a laser would stay on at rest",
        _ => "the job was not made for it",
    }
}
