//! Sheets as jobs: strokes of any shape, with each cutter and medium. A plan is read back as its own job.

use glam::DVec2;
use tatamu::drawing::{Drawing, Layer, Mark, Rgb, Stroke};
use tatamu::plotter::profile::{CUTTERS, MEDIA};
use tatamu::plotter::{Cutter, Job, Media, Plan};

/// Reads one input: two bytes choose cutter and medium, the others are layers and points.
pub fn run(bytes: &[u8]) {
    let Some((&[cutter, media], rest)) = bytes.split_first_chunk() else { return };
    let cutter = Cutter::parse(CUTTERS[usize::from(cutter) % CUTTERS.len()].text).expect("a profile");
    let media = Media::parse(MEDIA[usize::from(media) % MEDIA.len()].text).expect("a profile");
    let mut drawing = Drawing::new("fuzz", DVec2::new(210.0, 297.0));
    let look = Stroke::solid(0.2, Rgb::BLACK);
    let layers = [Layer::Cut, Layer::Slit, Layer::Mountain, Layer::FoldHinge];
    for stroke in rest.chunks(9) {
        let Some((&layer, points)) = stroke.split_first() else { continue };
        let points = points.chunks_exact(2).map(|p| DVec2::new(f64::from(p[0]), f64::from(p[1])) * 0.8);
        drawing.marks.push(Mark::polyline(
            layers[usize::from(layer) % layers.len()],
            points.collect(),
            &look,
        ));
    }
    if let Ok(plan) = Plan::new(&drawing, &cutter, &media) {
        assert!(Job::parse(plan.bytes(), &cutter).is_ok(), "{}", String::from_utf8_lossy(plan.bytes()));
    }
}
