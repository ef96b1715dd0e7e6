//! Drawings as pictures in the window: the same pixels as in a PNG file.

use eframe::egui::{self, Color32, ColorImage, TextureHandle, TextureOptions};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, LazyLock};
use tatamu::drawing::{Drawing, Rgb};
use tatamu::export::png;
use tatamu::units::MM_PER_INCH;

/// Finest and coarsest pictures, dots per inch.
const FINEST: f64 = 400.0;
const COARSEST: f64 = 20.0;
/// A picture serves for sizes up to this factor larger.
const STEP: f64 = 1.4;

/// Makes pictures one after the other: all at once they take much memory, and the cores from the window.
static DRAWER: LazyLock<Option<ThreadPool>> =
    LazyLock::new(|| ThreadPoolBuilder::new().num_threads(1).build().ok());

/// A picture of a drawing. It is made in the background; until then an older one serves.
#[derive(Default)]
pub struct Picture {
    key: Option<(u64, f64)>,
    texture: Option<TextureHandle>,
    coming: Option<Receiver<ColorImage>>,
    /// Alive while the picture that comes is wanted.
    wish: Arc<()>,
    /// That of the texture.
    version: u64,
}

impl Picture {
    /// The version that was asked for.
    #[cfg(test)]
    pub fn wanted(&self) -> Option<u64> {
        self.key.map(|(version, _)| version)
    }

    /// The picture for a scale, in pixels of the screen for a millimetre; none before the first is
    /// made. `version` tells drawings apart.
    pub fn texture(
        &mut self,
        ctx: &egui::Context,
        drawing: &Drawing,
        version: u64,
        pixels_per_mm: f64,
    ) -> Option<&TextureHandle> {
        // Steps of scale, so that zooming does not draw it again all the time.
        let wanted = (pixels_per_mm * MM_PER_INCH).clamp(COARSEST, FINEST);
        let dpi = COARSEST * STEP.powf((wanted / COARSEST).log(STEP).ceil());
        if self.key != Some((version, dpi)) {
            self.key = Some((version, dpi));
            let (sender, coming) = channel();
            self.coming = Some(coming);
            self.wish = Arc::default();
            let wish = Arc::downgrade(&self.wish);
            let drawing = Drawing { ground: Some(Rgb::WHITE), ..drawing.clone() };
            let ctx = ctx.clone();
            let draw = move || {
                if wish.strong_count() > 0
                    && let Ok(pixmap) = png::rasterise(&drawing, dpi)
                {
                    let size = [pixmap.width() as usize, pixmap.height() as usize];
                    let pixels =
                        pixmap.pixels().iter().map(|p| Color32::from_rgb(p.red(), p.green(), p.blue()));
                    let _ = sender.send(ColorImage::new(size, pixels.collect()));
                    ctx.request_repaint();
                }
            };
            match &*DRAWER {
                Some(pool) => pool.spawn(draw),
                None => draw(),
            }
        }
        if let Some(image) = self.coming.as_ref().and_then(|coming| coming.try_recv().ok()) {
            match &mut self.texture {
                Some(texture) => texture.set(image, TextureOptions::LINEAR),
                None => self.texture = Some(ctx.load_texture("drawing", image, TextureOptions::LINEAR)),
            }
            (self.coming, self.version) = (None, version);
        }
        self.texture.as_ref()
    }
}
