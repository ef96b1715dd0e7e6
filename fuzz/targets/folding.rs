//! The planner of the folding: drawn prisms on a board, near each other and of any height. Whatever it finds, each
//! component becomes flat once, in steps that follow on each other.

use std::fmt::Write;
use tatamu::fold::{FoldPlan, ModelMotion};
use tatamu::pipeline::{Options, shape_drawn};
use tatamu::progress::Silent;
use tatamu::project::Project;

/// Most prisms: with more, one input takes seconds.
const MOST: usize = 5;

/// Reads one input: five bytes for each prism.
pub fn run(bytes: &[u8]) {
    let mut text = "[[component]]\nname = 'board'\ntop = [[-70, -40], [70, -40], [70, 40], [-70, 40]]\n\
                    profiles = [[[0, 40], [0, 0]]]\n"
        .to_owned();
    for (k, &[edges, radius, height, x, y]) in bytes.as_chunks().0.iter().take(MOST).enumerate() {
        let (edges, radius, height) = (3 + edges % 5, 6 + radius % 24, 6 + height % 80);
        let [x, y] = [(x, 60), (y, 30)].map(|(byte, most)| (i32::from(byte) - 128) * most / 128);
        let _ = writeln!(
            text,
            "[[component]]\nname = 'p{k}'\ntop = {{ edges = {edges}, radius = {radius} }}\n\
             profiles = [[[0, {height}], [0, 0]]]\n\
             [component.joint]\nto = 'board'\npanel = 'top'\nat = [{x}, {y}]"
        );
    }
    let sketches = Project::parse(&text).and_then(|project| project.sketches()).expect("a project");
    // A prism may hang over the edge of the board.
    let Ok(shaped) = shape_drawn(&sketches, None, &Options::default(), &Silent) else { return };
    let model = shaped.model();
    let plan = FoldPlan::new(&ModelMotion::new(model), 0.25, &Silent).expect("nobody cancels");
    let mut order = plan.order().to_vec();
    order.sort_unstable();
    assert!(order.into_iter().eq(model.ids()), "{:?}", plan.order());
    let mut folded = vec![0.0; model.parts().len()];
    for step in plan.steps() {
        assert!(step.from == folded[step.part.0] && step.to > step.from, "{:?}", plan.steps());
        folded[step.part.0] = step.to;
    }
    assert!(folded.iter().all(|&share| share == 1.0), "{:?}", plan.steps());
    let depths =
        plan.clashes().iter().map(|clash| clash.depth_mm).chain(plan.overlaps().iter().map(|o| o.depth_mm));
    assert!(depths.into_iter().all(|mm| mm.is_finite() && mm >= 0.0));
}
