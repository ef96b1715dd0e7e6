//! What a machine is like.

use super::fields::{Ascii, BladeOffset, DialectName, DirectionName, OriginName, Positive, RatioText};
use super::grbl::Grbl;
use super::level::Level;
use super::search::Search;
use super::{ProfileError, check_unverified};
use crate::plotter::dialect::{Dialect, Dmpl, Ebb, Gcode, Gpgl, Hpgl, UNITS_PER_MM};
use crate::plotter::{Direction, Frame, Origin};
use crate::toolpath::Operation;
use glam::DVec2;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;
use tatamu_draw::drawing::Registration;

/// The smallest buffer of a machine that is not counted by lines, bytes: that of the HP 7440A.
pub(crate) const LEAST_BUFFER: usize = 60;

/// How the program keeps from sending more than the machine has room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Handshake {
    /// Whatever the machine answers to; else what its profile falls back to.
    Auto,
    /// The machine is asked for its free bytes.
    EscB,
    /// The machine holds the line CTS low.
    RtsCts,
    /// The machine sends XOFF and XON.
    XonXoff,
    /// No more is sent than the machine has certainly done by now.
    Paced,
    /// The machine says `ok` to each line, and what it has not said that of has to fit its buffer (GRBL).
    Count,
    /// The machine says `OK` to each command, and gets the next one then (EBB).
    Ok,
    /// The port itself takes no more than the machine has room for, and the machine says whether it is ready.
    Usb,
}

impl Handshake {
    /// All of them, in the order of help texts.
    pub const ALL: [Self; 8] =
        [Self::Auto, Self::EscB, Self::RtsCts, Self::XonXoff, Self::Paced, Self::Count, Self::Ok, Self::Usb];

    /// Name in small letters.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::EscB => "escb",
            Self::RtsCts => "rtscts",
            Self::XonXoff => "xonxoff",
            Self::Paced => "paced",
            Self::Count => "count",
            Self::Ok => "ok",
            Self::Usb => "usb",
        }
    }
}

/// Parity of the serial line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Parity {
    /// No parity bit.
    None,
    /// Even parity.
    Even,
    /// Odd parity.
    Odd,
}

/// The serial line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "SerialTable")]
pub struct Serial {
    /// Bits a second.
    pub baud: u32,
    /// 7 or 8.
    pub data_bits: u8,
    /// Parity.
    pub parity: Parity,
    /// 1 or 2.
    pub stop_bits: u8,
    /// Handshake to use where the user does not say; `auto` probes.
    pub handshake: Handshake,
    /// What `auto` uses for a machine that does not answer.
    pub fallback: Handshake,
    /// Size of the machine's buffer, bytes.
    pub buffer_bytes: usize,
    /// Whether the machine may be sent questions and device control.
    pub answers: bool,
}

impl Serial {
    /// Time that a byte takes on the line, s.
    pub fn byte_s(&self) -> f64 {
        let parity = u8::from(self.parity != Parity::None);
        f64::from(1 + self.data_bits + parity + self.stop_bits) / f64::from(self.baud)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SerialTable {
    baud: u32,
    data_bits: u8,
    parity: Parity,
    stop_bits: u8,
    handshake: Handshake,
    fallback: Handshake,
    buffer_bytes: usize,
    answers: bool,
}

impl TryFrom<SerialTable> for Serial {
    type Error = String;

    fn try_from(table: SerialTable) -> Result<Self, String> {
        let SerialTable { baud, data_bits, parity, stop_bits, handshake, fallback, buffer_bytes, answers } =
            table;
        let ensure = |holds: bool, message: &str| if holds { Ok(()) } else { Err(message.to_owned()) };
        ensure((300..=4_000_000).contains(&baud), "baud must be from 300 to 4000000")?;
        ensure(matches!(data_bits, 7 | 8), "data_bits must be 7 or 8")?;
        ensure(matches!(stop_bits, 1 | 2), "stop_bits must be 1 or 2")?;
        // A machine that counts takes single lines; others keep room for what lifts the tool.
        let (least, message) = match handshake {
            Handshake::Count => (80, "buffer_bytes must be at least 80"),
            _ => (LEAST_BUFFER, "buffer_bytes must be at least 60"),
        };
        ensure((least..=1 << 30).contains(&buffer_bytes), message)?;
        ensure(
            answers || !matches!(handshake, Handshake::Count | Handshake::Ok),
            "count and ok need a machine that answers: set answers = true",
        )?;
        let needs_answers = [handshake, fallback].contains(&Handshake::EscB);
        ensure(answers || !needs_answers, "escb needs a machine that answers: set answers = true")?;
        ensure(
            matches!(fallback, Handshake::RtsCts | Handshake::XonXoff | Handshake::Paced),
            "fallback must be rtscts, xonxoff or paced",
        )?;
        Ok(Self { baud, data_bits, parity, stop_bits, handshake, fallback, buffer_bytes, answers })
    }
}

/// A tool of the machine.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MachineTool {
    #[serde(default)]
    select: Ascii,
    /// Sets the tool down, where a move with the tool down does not do that itself.
    #[serde(default)]
    lower: Ascii,
    #[serde(default)]
    blade_offset_mm: BladeOffset,
}

impl MachineTool {
    /// The command that takes the tool up.
    pub fn select(&self) -> &str {
        &self.select.0
    }

    /// Whether it is the same tool: one that is set down deeper is.
    pub fn is(&self, other: &Self) -> bool {
        (&self.select, self.blade_offset_mm) == (&other.select, other.blade_offset_mm)
    }

    /// The commands that set it down before it draws; empty where drawing does that itself.
    pub fn lower(&self) -> &str {
        &self.lower.0
    }

    /// Distance from the shaft's axis to the blade's tip, mm.
    pub fn blade_offset_mm(&self) -> f64 {
        self.blade_offset_mm.0
    }
}

/// A machine.
///
/// # Guarantees
/// What its parts guarantee; at least one tool.
#[derive(Debug, Clone)]
pub struct Cutter {
    text: String,
    name: String,
    description: String,
    unverified: Vec<String>,
    dialect: Arc<dyn Dialect>,
    frame: Frame,
    serial: Serial,
    motion: MotionTable,
    commands: CommandTable,
    force: Option<Level>,
    speed: Option<Level>,
    power: Option<Level>,
    grbl: Option<Grbl>,
    marks: BTreeMap<String, Search>,
    tools: [Option<MachineTool>; Operation::ALL.len()],
}

impl Cutter {
    /// Reads a profile.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn parse(text: &str) -> Result<Self, ProfileError> {
        let file: CutterFile = toml::from_str(text)?;
        check_unverified(text, &file.unverified)?;
        let tools = file.tools;
        let tools = [tools.pen, tools.crease, tools.fold_hinge, Some(tools.cut)];
        let lower: Vec<&str> = tools.iter().flatten().map(MachineTool::lower).collect();
        let lift = file.commands.lift.0.as_str();
        let units = file.frame.0.units_per_mm().value();
        let ensure = |holds: bool, message| if holds { Ok(()) } else { Err(ProfileError::Whole(message)) };
        let speeds_mm_s = [file.motion.travel_mm_s.0, file.motion.draw_mm_s.0];
        let ebb = || Ebb::new(lift, units, speeds_mm_s, file.motion.acceleration_mm_s2.0);
        let too_fast = "the motors step at most 25000 times a second: lower travel_mm_s and draw_mm_s";
        let dialect: Arc<dyn Dialect> = match file.dialect {
            DialectName::Hpgl => Arc::new(Hpgl),
            DialectName::Gpgl => Arc::new(Gpgl),
            DialectName::Dmpl => Arc::new(Dmpl),
            DialectName::Gcode => Arc::new(Gcode::new(lift, &lower)),
            DialectName::Ebb => Arc::new(ebb().ok_or(ProfileError::Whole(too_fast))?),
        };
        let is_gcode = file.dialect == DialectName::Gcode;
        let counts = file.serial.handshake == Handshake::Count;
        let is_ebb = file.dialect == DialectName::Ebb;
        let has_own_pen = is_gcode || is_ebb;
        ensure(!is_gcode || units == f64::from(UNITS_PER_MM), "gcode needs units_per_mm = \"1000\"")?;
        let has_lines = !lift.is_empty() && lower.iter().all(|text| !text.is_empty());
        ensure(
            !has_own_pen || has_lines,
            "gcode and ebb need lift in [commands], and lower in each of the tools",
        )?;
        ensure(
            has_own_pen || lift.is_empty() && lower.concat().is_empty(),
            "lift and lower are for gcode and ebb only",
        )?;
        ensure(
            is_ebb == (file.serial.handshake == Handshake::Ok),
            "ebb and handshake = \"ok\" need each other",
        )?;
        ensure(counts == file.grbl.is_some(), "handshake = \"count\" and the table [grbl] need each other")?;
        ensure(is_gcode || !counts, "handshake = \"count\" is for gcode only")?;
        let has_state = !dialect.state_question().is_empty() || file.serial.handshake != Handshake::Usb;
        ensure(has_state, "handshake = \"usb\" is for gpgl only")?;
        let knows = |name: &String| Registration::of_name(name).is_some_and(Registration::is_for_machines);
        ensure(file.marks.keys().all(knows), "[marks] has tables silhouette and silhouette-alpha only")?;
        let looks = |search: &Search| {
            let text = search.command([DVec2::ZERO, DVec2::ONE], DVec2::ONE, &file.frame.0);
            dialect.split(text.as_bytes()).last().is_some_and(|command| dialect.is_search(command))
        };
        ensure(file.marks.values().all(looks), "search must end with TB123 or TB124, and is for gpgl only")?;
        Ok(Self {
            text: text.to_owned(),
            name: file.name,
            description: file.description,
            unverified: file.unverified,
            dialect,
            frame: file.frame.0,
            serial: file.serial,
            motion: file.motion,
            commands: file.commands,
            force: file.force,
            speed: file.speed,
            power: file.power,
            grbl: file.grbl,
            marks: file.marks,
            tools,
        })
    }

    /// The profile as it was read.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Name for people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it is and what to mind.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Fields that nobody has tried on a machine.
    pub fn unverified(&self) -> &[String] {
        &self.unverified
    }

    /// Whether it answers questions about its buffer.
    pub(crate) fn can_be_asked(&self) -> bool {
        self.serial.answers && self.dialect.controls().is_some()
    }

    /// Whether a handshake is possible with its language and its answers.
    pub fn can_use(&self, handshake: Handshake) -> bool {
        match handshake {
            Handshake::EscB => self.can_be_asked(),
            Handshake::Count => self.grbl.is_some(),
            Handshake::Usb => !self.dialect.state_question().is_empty(),
            Handshake::Ok => self.dialect.counts_distances(),
            _ => !self.dialect.counts_distances(),
        }
    }

    /// Its language.
    pub fn dialect(&self) -> &Arc<dyn Dialect> {
        &self.dialect
    }

    /// How a session with GRBL begins and pauses, where it speaks that.
    pub fn grbl(&self) -> Option<&Grbl> {
        self.grbl.as_ref()
    }

    /// How it looks for marks of a kind, where it can.
    pub fn search(&self, marks: Registration) -> Option<&Search> {
        self.marks.get(marks.name())
    }

    /// Its coordinates.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Its serial line.
    pub fn serial(&self) -> &Serial {
        &self.serial
    }

    /// Speed with the tool up, mm/s.
    pub(crate) fn travel_mm_s(&self) -> f64 {
        self.motion.travel_mm_s.0
    }

    /// Speed with the tool down where the medium or the machine does not set one, mm/s.
    pub fn draw_mm_s(&self) -> f64 {
        self.motion.draw_mm_s.0
    }

    /// How fast it gains and loses speed, mm/s².
    pub(crate) fn acceleration_mm_s2(&self) -> f64 {
        self.motion.acceleration_mm_s2.0
    }

    /// Time to lift the tool or set it down, s.
    pub(crate) fn pen_s(&self) -> f64 {
        self.motion.pen_s.0
    }

    /// Commands before everything else.
    pub fn start(&self) -> &str {
        &self.commands.start.0
    }

    /// Commands after everything else.
    pub fn end(&self) -> &str {
        &self.commands.end.0
    }

    /// Commands after the tool was lifted because the job is stopped.
    pub fn stop(&self) -> &str {
        &self.commands.stop.0
    }

    /// What stands after each command.
    pub fn separator(&self) -> &str {
        &self.commands.separator.0
    }

    /// Its force, in grams, where it can be set.
    pub fn force(&self) -> Option<&Level> {
        self.force.as_ref()
    }

    /// Its speed, in mm/s, where it can be set.
    pub fn speed(&self) -> Option<&Level> {
        self.speed.as_ref()
    }

    /// Its power, in percent, where it can be set: that of a laser.
    pub fn power(&self) -> Option<&Level> {
        self.power.as_ref()
    }

    /// The tool for an operation; none where the machine leaves it out.
    pub fn tool(&self, operation: Operation) -> Option<&MachineTool> {
        self.tools[operation as usize].as_ref()
    }
}

impl PartialEq for Cutter {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

/// The file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CutterFile {
    name: String,
    description: String,
    #[serde(default)]
    unverified: Vec<String>,
    dialect: DialectName,
    frame: FrameField,
    serial: Serial,
    motion: MotionTable,
    commands: CommandTable,
    force: Option<Level>,
    speed: Option<Level>,
    power: Option<Level>,
    grbl: Option<Grbl>,
    #[serde(default)]
    marks: BTreeMap<String, Search>,
    tools: ToolTables,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct MotionTable {
    travel_mm_s: Positive,
    draw_mm_s: Positive,
    acceleration_mm_s2: Positive,
    pen_s: Positive,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct CommandTable {
    start: Ascii,
    end: Ascii,
    stop: Ascii,
    #[serde(default)]
    lift: Ascii,
    #[serde(default)]
    separator: Ascii,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct ToolTables {
    pen: Option<MachineTool>,
    crease: Option<MachineTool>,
    fold_hinge: Option<MachineTool>,
    cut: MachineTool,
}

#[derive(Deserialize)]
#[serde(try_from = "FrameTable")]
struct FrameField(Frame);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FrameTable {
    units_per_mm: RatioText,
    #[serde(with = "OriginName")]
    origin: Origin,
    #[serde(default)]
    offset_mm: [f64; 2],
    #[serde(with = "DirectionName")]
    x: Direction,
    #[serde(with = "DirectionName")]
    y: Direction,
    bed_x_mm: [f64; 2],
    bed_y_mm: [f64; 2],
    range: [i32; 2],
}

impl TryFrom<FrameTable> for FrameField {
    type Error = String;

    fn try_from(table: FrameTable) -> Result<Self, String> {
        let offset_mm = DVec2::from(table.offset_mm);
        if !offset_mm.is_finite() {
            return Err("offset_mm needs two numbers".to_owned());
        }
        let beds = [table.bed_x_mm, table.bed_y_mm];
        Frame::new(table.units_per_mm.0, (table.origin, offset_mm), [table.x, table.y], beds, table.range)
            .map(Self)
    }
}
