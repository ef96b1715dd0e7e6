//! Checks how meshes fold, and how long the check takes:
//! `cargo run --release --example folding -- samples/teddy.obj`.

use std::error::Error;
use std::time::Instant;
use tatamu::fold::{FoldPlan, ModelMotion};
use tatamu::mesh::{self, Mesh};
use tatamu::model::PartId;
use tatamu::pipeline::{self, Options};
use tatamu::progress::Silent;

/// Thickness of card of about 200 g/m².
const THICKNESS_MM: f64 = 0.25;

fn main() -> Result<(), Box<dyn Error>> {
    for path in std::env::args().skip(1) {
        let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(&path)?)?)?;
        let result = pipeline::run(&mesh, &Options::default(), &Silent)?;
        let model = result.model();
        let name = |part: PartId| model.part(part).name.as_str();
        let start = Instant::now();
        let plan = FoldPlan::new(&ModelMotion::new(model), THICKNESS_MM, &Silent)?;
        let seconds = start.elapsed().as_secs_f64();
        println!("{path}: {} components, {seconds:.3} s", model.parts().len());
        let names: Vec<&str> = plan.order().iter().map(|&part| name(part)).collect();
        println!("  order {}", names.join(", "));
        for clash in plan.clashes() {
            let [a, b] = clash.parts.map(name);
            let mover = name(clash.mover);
            let percent = 100.0 * clash.folded;
            println!("  {a} and {b} clash by {:.2} mm, {mover} {percent:.0}% folded", clash.depth_mm);
        }
        for overlap in plan.overlaps() {
            let [a, b] = overlap.parts.map(name);
            println!("  {a} and {b} stand in each other by {:.2} mm", overlap.depth_mm);
        }
        for stack in plan.stacks() {
            println!("  flat {:.0} mm, {} layers, {:.1} mm", stack.size_mm, stack.layers, stack.height_mm);
        }
    }
    Ok(())
}
