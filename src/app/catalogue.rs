//! Machines that people own, by maker, and what each takes.

/// What a machine takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Takes {
    /// A job by a profile, over a serial port.
    Serial(&'static str),
    /// A job by a profile, over USB.
    Usb(&'static str),
    /// A file for a program.
    Program(&'static str),
}

/// A machine, or several that take the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Machine {
    /// Who makes it.
    pub maker: &'static str,
    /// Its models.
    pub models: &'static str,
    /// What it takes.
    pub takes: Takes,
}

/// The machines, by maker.
pub const MACHINES: [Machine; 19] = [
    machine("AxiDraw", "V3, SE, and others with an EiBotBoard", Takes::Serial("axidraw")),
    machine("Brother", "ScanNCut CM, DX, SDX", Takes::Program("scanncut")),
    machine("Cricut", "Explore, Maker, Joy, Venture", Takes::Program("cricut")),
    machine("Graphtec", "CE, FC", Takes::Serial("graphtec")),
    machine("HP", "7475A", Takes::Serial("hp-7475a")),
    machine("HP", "7550A", Takes::Serial("hp-7550a")),
    machine("Houston Instrument", "DMP, and others with DM/PL", Takes::Serial("dmpl")),
    machine("Roland", "CAMM-1", Takes::Serial("roland-camm-1")),
    machine("Silhouette", "Cameo 3 to 5; Portrait 3, 4", Takes::Usb("silhouette")),
    machine("Silhouette", "Cameo 5 Alpha, Cameo Pro MK-II", Takes::Usb("silhouette-alpha")),
    machine("Silhouette", "Cameo 1, 2; Portrait 1, 2", Takes::Usb("silhouette-classic")),
    machine("Silhouette", "all, with Silhouette Studio", Takes::Program("silhouette-studio")),
    machine("vinyl cutters", "with HP-GL", Takes::Serial("generic-hpgl")),
    machine("vinyl cutters", "low-cost, that lose commands", Takes::Serial("vinyl-cutter")),
    machine("lasers", "with LightBurn", Takes::Program("lightburn")),
    machine("lasers", "with GRBL: Atomstack, Ortur, Sculpfun, xTool D1", Takes::Serial("grbl-laser")),
    machine("own builds", "drag knife with GRBL and Z", Takes::Serial("grbl-knife")),
    machine("own builds", "pen with GRBL and a servo", Takes::Serial("grbl-pen")),
    machine("own builds", "pen with HP-GL", Takes::Serial("pen-plotter")),
];

const fn machine(maker: &'static str, models: &'static str, takes: Takes) -> Machine {
    Machine { maker, models, takes }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::plotter::profile::CUTTERS;
    use tatamu::project::options::{FOR, Given};

    #[test]
    fn every_machine_takes_something_that_there_is_and_every_profile_has_a_machine() {
        for machine in MACHINES {
            match machine.takes {
                Takes::Serial(name) | Takes::Usb(name) => {
                    assert!(CUTTERS.iter().any(|p| p.name == name), "{name}")
                }
                Takes::Program(name) => assert!(Given::of_flag(&FOR, name).is_ok(), "{name}"),
            }
        }
        let has = |name: &str| {
            MACHINES.iter().any(|m| matches!(m.takes, Takes::Serial(p) | Takes::Usb(p) if p == name))
        };
        CUTTERS.iter().for_each(|profile| assert!(has(profile.name), "{}", profile.name));
    }
}
