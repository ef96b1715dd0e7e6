//! From a component's panels to its net.

use super::chains::Chains;
use super::contour::cut_lines;
use super::cuts::{Candidate, Problem, divide};
use super::labels::Placer;
use super::layout::{self, Layout, across, best_turn, edge, hinge_length, measured, turn};
use super::marks::{Crease, creases};
use super::mesh::{EdgeKind, PieceMesh};
use super::tabs::{self, Placed, Shapes, USEFUL_WIDTH_MM};
use super::{JointMark, Net, NetWarning, Piece, PlacedPanel, Tab};
use crate::component::{HingeId, PanelId, PanelSet};
use crate::geom::polygon;
use glam::{DAffine2, DVec2};
use std::collections::BTreeMap;

/// Hinges shorter than this cost extra to glue.
const LONG_HINGE_MM: f64 = 15.0;
/// Cost of gluing in the middle of a chain rather than at the top or bottom panel.
const MIDDLE_COST: f64 = 0.4;
/// Cost of gluing a fold hinge.
const FOLD_COST: f64 = 30.0;
/// Cost of a hinge that has no room for a useful tab.
const NO_TAB_COST: f64 = 10.0;

/// A bounding box may be larger by this factor where the piece then lies straight.
const NEAT_FACTOR: f64 = 1.12;

/// Why a component has no net.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NetError {
    /// A single panel is larger than the sheet.
    #[error(
        "a panel of {name} measures {:.0} × {:.0} mm and does not fit the sheet of \
         {:.0} × {:.0} mm; make the model smaller by a factor of {scale:.3}, or the paper larger",
        size_mm.x, size_mm.y, sheet_mm.x, sheet_mm.y
    )]
    PanelTooLarge {
        /// The component.
        name: String,
        /// The panel.
        panel: PanelId,
        /// Its bounding box in the best position, mm.
        size_mm: DVec2,
        /// Room on the sheet, mm.
        sheet_mm: DVec2,
        /// Factor, below 1, by which the model must shrink for this panel to fit.
        scale: f64,
    },
    /// The panels are not a top panel, chains and a bottom panel.
    #[error("the panels do not make chains from top to bottom: {what} is missing")]
    NotChains {
        /// What is missing.
        what: String,
    },
}

/// How nets are made.
#[derive(Debug, Clone, PartialEq)]
pub struct NetOptions {
    /// Width of tabs, mm; less on short edges.
    pub tab_width_mm: f64,
    /// Room for pieces on a sheet: width and height within the margins, mm.
    pub sheet_mm: DVec2,
}

/// Names that appear on the pieces of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Naming<'a> {
    /// The component's name.
    pub name: &'a str,
    /// Beginning of its labels: `A` gives `A1`, `A2`, …
    pub prefix: &'a str,
}

/// Makes the net of a component: the best one-piece net that fits the sheet with all its tabs;
/// where there is none, two pieces, then more.
///
/// # Errors
/// [`NetError::PanelTooLarge`] where one panel alone does not fit the sheet (the largest such
/// panel is named); [`NetError::NotChains`] for panels that are no component.
pub fn develop(
    set: &PanelSet,
    naming: Naming<'_>,
    joints: &[JointMark],
    options: &NetOptions,
) -> Result<Net, NetError> {
    let chains = Chains::of(set)?;
    check_panels(set, naming.name, options.sheet_mm)?;
    let shapes = tabs::shapes(set, options.tab_width_mm);
    let cut_cost = cut_costs(set, &chains, &shapes, options.tab_width_mm);
    let problem = |may_cut_folds| Problem {
        set,
        chains: &chains,
        sheet_mm: options.sheet_mm,
        cut_cost: &cut_cost,
        may_cut_folds,
    };
    let draft = [false, true]
        .into_iter()
        .map(problem)
        .find_map(|problem| {
            [Problem::one_piece, Problem::two_pieces, Problem::with_strips]
                .iter()
                .find_map(|search| best_draft(&problem, search(&problem), &shapes, options))
        })
        .unwrap_or_else(|| last_resort(&problem(true), &shapes));
    Ok(finish(set, draft, naming, joints, options))
}

/// Cuts, layouts and tabs, before texts.
struct Draft {
    layouts: Vec<Layout>,
    cut: Vec<HingeId>,
    tabs: Vec<Placed>,
}

fn check_panels(set: &PanelSet, name: &str, sheet_mm: DVec2) -> Result<(), NetError> {
    let turns = set.panels().iter().map(|p| best_turn(&p.outline, sheet_mm)).enumerate();
    match turns.min_by(|a, b| a.1.scale.total_cmp(&b.1.scale)) {
        Some((panel, best)) if !best.fits() => Err(NetError::PanelTooLarge {
            name: name.to_owned(),
            panel: PanelId(panel),
            size_mm: best.size_mm,
            sheet_mm,
            scale: best.scale,
        }),
        _ => Ok(()),
    }
}

fn cut_costs(set: &PanelSet, chains: &Chains, shapes: &[Shapes], tab_width_mm: f64) -> Vec<f64> {
    let mut costs = vec![0.0; set.hinges().len()];
    for chain in &chains.chains {
        for (place, &hinge) in chain.hinges.iter().enumerate() {
            let is_end = place == 0 || place + 1 == chain.hinges.len();
            let short = (1.0 - hinge_length(set, hinge) / LONG_HINGE_MM).max(0.0);
            let widest = tabs::widest(&shapes[hinge.0]);
            costs[hinge.0] = 1.0
                + short
                + if is_end { 0.0 } else { MIDDLE_COST }
                + if set.hinges()[hinge.0].is_fold { FOLD_COST } else { 0.0 }
                + (1.0 - widest / tab_width_mm).max(0.0)
                + if widest < USEFUL_WIDTH_MM { NO_TAB_COST } else { 0.0 };
        }
    }
    costs
}

/// The best of the candidates that has room for all its tabs; narrow tabs count against it.
fn best_draft(
    problem: &Problem<'_>,
    candidates: Vec<Candidate>,
    shapes: &[Shapes],
    options: &NetOptions,
) -> Option<Draft> {
    let mut best: Option<(f64, Draft)> = None;
    for candidate in candidates {
        if best.as_ref().is_some_and(|b| b.0 <= candidate.cost) {
            break;
        }
        let layouts = layout::pieces(problem.set, &candidate.is_cut);
        let cut = cut_hinges(&candidate.is_cut);
        let placed =
            tabs::place(problem.set, &layouts, options.sheet_mm, shapes, &cut, USEFUL_WIDTH_MM);
        let Ok(tabs) = placed else { continue };
        let lack = |t: &Placed| 1.0 - t.width_mm() / tabs::widest(&shapes[t.hinge.0]);
        let cost = candidate.cost + tabs.iter().map(lack).sum::<f64>();
        if best.as_ref().is_none_or(|b| cost < b.0) {
            best = Some((cost, Draft { layouts, cut, tabs }));
        }
    }
    best.map(|b| b.1)
}

/// Cuts every chain at its fold hinge, or where the best two pieces are cut whatever their size,
/// and then whatever is still too large or overlaps.
fn last_resort(problem: &Problem<'_>, shapes: &[Shapes]) -> Draft {
    let set = problem.set;
    let unbounded = Problem { sheet_mm: DVec2::INFINITY, ..*problem };
    let start = unbounded.two_pieces().into_iter().next().map_or_else(
        || {
            let mut is_cut = vec![false; set.hinges().len()];
            for (j, chain) in problem.chains.chains.iter().enumerate() {
                is_cut[chain.hinges[problem.chains.fold_place(set, j)].0] = true;
            }
            is_cut
        },
        |best| best.is_cut,
    );
    let mut is_cut = divide(problem, start);
    let mut least_mm = USEFUL_WIDTH_MM;
    loop {
        let layouts = layout::pieces(set, &is_cut);
        let cut = cut_hinges(&is_cut);
        match tabs::place(set, &layouts, problem.sheet_mm, shapes, &cut, least_mm) {
            Ok(tabs) => return Draft { layouts, cut, tabs },
            Err(hinge) => {
                let more = further_cut(problem, &layouts, hinge);
                match more {
                    Some(hinge) => is_cut[hinge.0] = true,
                    None if least_mm > 0.0 => least_mm = 0.0,
                    None => {
                        let tabs = where_room(problem, &layouts, shapes, cut.clone());
                        return Draft { layouts, cut, tabs };
                    }
                }
            }
        }
    }
}

/// Tabs for all hinges that have room.
fn where_room(
    problem: &Problem<'_>,
    layouts: &[Layout],
    shapes: &[Shapes],
    mut cut: Vec<HingeId>,
) -> Vec<Placed> {
    loop {
        match tabs::place(problem.set, layouts, problem.sheet_mm, shapes, &cut, 0.0) {
            Ok(tabs) => return tabs,
            Err(hinge) => cut.retain(|&h| h != hinge),
        }
    }
}

/// The cheapest hinge to cut further in the pieces next to a hinge whose tab has no room.
fn further_cut(problem: &Problem<'_>, layouts: &[Layout], hinge: HingeId) -> Option<HingeId> {
    let sides = problem.set.hinges()[hinge.0].sides;
    layouts
        .iter()
        .filter(|l| sides.iter().any(|s| l.place(s.panel).is_some()))
        .flat_map(|l| l.creases.iter().copied())
        .min_by(|a, b| problem.cut_cost[a.0].total_cmp(&problem.cut_cost[b.0]))
}

fn cut_hinges(is_cut: &[bool]) -> Vec<HingeId> {
    (0..is_cut.len()).filter(|&h| is_cut[h]).map(HingeId).collect()
}

fn finish(
    set: &PanelSet,
    draft: Draft,
    naming: Naming<'_>,
    joints: &[JointMark],
    options: &NetOptions,
) -> Net {
    let Draft { mut layouts, cut, tabs } = draft;
    layouts.sort_by_key(|l| std::cmp::Reverse(l.panels.len()));
    let labels: BTreeMap<HingeId, String> =
        cut.iter().zip(1..).map(|(&h, number)| (h, format!("{}{number}", naming.prefix))).collect();
    let count = layouts.len();
    let pieces: Vec<Piece> = layouts
        .into_iter()
        .enumerate()
        .map(|(k, layout)| {
            let name = match count {
                1 => naming.name.to_owned(),
                _ => format!("{} {}/{count}", naming.name, k + 1),
            };
            let own: Vec<Placed> = tabs
                .iter()
                .filter(|t| layout.place(set.hinges()[t.hinge.0].sides[t.side].panel).is_some())
                .cloned()
                .collect();
            piece(set, &layout, &own, name, joints, options.sheet_mm, &labels)
        })
        .collect();
    let warnings = warnings(set, &tabs, &pieces, &labels);
    Net { pieces, warnings, labels }
}

fn piece(
    set: &PanelSet,
    layout: &Layout,
    own: &[Placed],
    name: String,
    joints: &[JointMark],
    sheet_mm: DVec2,
    labels: &BTreeMap<HingeId, String>,
) -> Piece {
    let on_panel: Vec<(Placed, [DVec2; 4])> = own
        .iter()
        .filter_map(|t| {
            let side = set.hinges()[t.hinge.0].sides[t.side];
            let place = layout.place(side.panel)?;
            let outline = t.shape.outline(edge(set, side));
            Some((t.clone(), outline.map(|p| place.transform_point2(p))))
        })
        .collect();
    let mesh = PieceMesh::new(set, layout, &on_panel);
    let points: Vec<DVec2> = mesh.vertices().iter().map(|v| v.at).collect();
    let upright = to_sheet(&points, &creases(set, &mesh), sheet_mm);
    let mesh = mesh.moved(|p| upright.transform_point2(p));
    let tabs: Vec<Tab> = on_panel
        .iter()
        .map(|(t, outline)| {
            let side = set.hinges()[t.hinge.0].sides[t.side];
            let to_mate = across(set, t.hinge, t.side).inverse();
            Tab {
                hinge: t.hinge,
                side: t.side,
                outline: outline.map(|p| upright.transform_point2(p)),
                on_mate: t.shape.outline(edge(set, side)).map(|p| to_mate.transform_point2(p)),
                label: labels.get(&t.hinge).cloned().unwrap_or_default(),
            }
        })
        .collect();
    let panels: Vec<PlacedPanel> = layout
        .panels
        .iter()
        .map(|&(panel, place)| PlacedPanel { panel, place: upright * place })
        .collect();
    let mut placer = Placer::new(&mesh);
    let place_of = |id| panels.iter().find(|p| p.panel == id).map(|p| p.place);
    let joints = placer.joints(joints, place_of);
    placer.glued(&tabs, |kind| match kind {
        EdgeKind::Tab(h) | EdgeKind::Mate(h) => labels.get(h).cloned(),
        _ => None,
    });
    placer.name(&name);
    let (labels, unplaced_labels) = placer.finish();
    let lines = cut_lines(mesh.border());
    Piece {
        name,
        panels,
        creases: layout.creases.clone(),
        tabs,
        joints,
        labels,
        unplaced_labels,
        crease_lines: creases(set, &mesh),
        outline: lines.outline,
        slits: lines.slits,
        mesh,
    }
}

/// The rigid motion that turns a piece as it fits the sheet, its bounding box at the origin: with
/// a crease upright or level where that costs little, else with the smallest box.
fn to_sheet(points: &[DVec2], creases: &[Crease], sheet_mm: DVec2) -> DAffine2 {
    let best = best_turn(points, sheet_mm);
    let most = best.size_mm.element_product() * NEAT_FACTOR;
    let neat = creases
        .iter()
        .flat_map(|c| [c.direction(), c.direction().perp()])
        .map(|d| measured(points, DVec2::new(d.x, -d.y), sheet_mm))
        .filter(|turn| turn.fits() && turn.size_mm.element_product() <= most)
        .reduce(|a, b| if b.beats(&a) { b } else { a });
    let rotation = turn(neat.unwrap_or(best).unit);
    let (lo, _) = polygon::bounds(points.iter().map(|&p| rotation * p)).unwrap_or_default();
    DAffine2::from_mat2_translation(rotation, -lo)
}

fn warnings(
    set: &PanelSet,
    tabs: &[Placed],
    pieces: &[Piece],
    labels: &BTreeMap<HingeId, String>,
) -> Vec<NetWarning> {
    let mut out = Vec::new();
    for (&hinge, label) in labels {
        let label = label.clone();
        if set.hinges()[hinge.0].is_fold {
            out.push(NetWarning::CutFoldHinge { label: label.clone() });
        }
        match tabs.iter().find(|t| t.hinge == hinge).map(Placed::width_mm) {
            None => out.push(NetWarning::NoTab { label }),
            Some(width_mm) if width_mm < USEFUL_WIDTH_MM => {
                out.push(NetWarning::NarrowTab { label, width_mm });
            }
            Some(_) => {}
        }
    }
    for piece in pieces {
        for text in &piece.unplaced_labels {
            let (piece, text) = (piece.name.clone(), text.clone());
            out.push(NetWarning::UnplacedLabel { piece, text });
        }
    }
    out
}
