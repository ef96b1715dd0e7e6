//! Pages on a table that is moved and magnified.

use eframe::egui::{self, Painter, Pos2, Rect, Shape, Stroke, Vec2};
use glam::DVec2;

/// Room between pages, mm.
const GAP_MM: f32 = 12.0;
/// Least and most points of the screen for a millimetre.
const SCALES: [f32; 2] = [0.05, 30.0];

/// From where the table is seen.
#[derive(Debug, Clone, Copy, Default)]
pub struct Canvas {
    /// Points for a millimetre, and where the table's corner is in the window; none shows all of it.
    view: Option<(f32, Vec2)>,
}

/// Where the pages are on the screen.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// Points for a millimetre.
    pub scale: f32,
    /// The pages.
    pub pages: Vec<Rect>,
    corner: Vec2,
}

impl Canvas {
    /// Shows all pages.
    pub fn fit(&mut self) {
        self.view = None;
    }

    /// Whether all pages are shown.
    pub fn is_fitted(&self) -> bool {
        self.view.is_none()
    }

    /// Pages of one size in a window.
    pub fn seen(&self, count: usize, size_mm: Vec2, window: Rect) -> Seen {
        let columns = columns(count, size_mm, window.size());
        let rows = count.div_ceil(columns);
        let step = size_mm + Vec2::splat(GAP_MM);
        let all = step * Vec2::new(columns as f32, rows as f32) + Vec2::splat(GAP_MM);
        let fitting = (window.width() / all.x).min(window.height() / all.y).clamp(SCALES[0], SCALES[1]);
        let (scale, corner) = self.view.unwrap_or((fitting, 0.5 * (window.size() - fitting * all)));
        let page = |k: usize| {
            let place = step * Vec2::new((k % columns) as f32, (k / columns) as f32) + Vec2::splat(GAP_MM);
            Rect::from_min_size(window.min + corner + scale * place, scale * size_mm)
        };
        Seen { scale, corner, pages: (0..count).map(page).collect() }
    }

    /// Moves the table.
    pub fn pan(&mut self, seen: &Seen, by: Vec2) {
        self.view = Some((seen.scale, seen.corner + by));
    }

    /// Magnifies about a point of the screen.
    pub fn zoom(&mut self, seen: &Seen, window: Rect, factor: f32, at: Pos2) {
        let scale = (seen.scale * factor).clamp(SCALES[0], SCALES[1]);
        let at = at - window.min;
        self.view = Some((scale, at + (seen.corner - at) * (scale / seen.scale)));
    }

    /// Moves the table so that a rectangle of the screen is in the window.
    pub fn bring(&mut self, seen: &Seen, window: Rect, target: Rect) {
        if !window.contains_rect(target) && self.view.is_some() {
            self.pan(seen, window.center() - target.center());
        }
    }
}

/// Draws an outline, edge by edge: mitres of a path would stick out far at its sharp corners.
pub fn draw(painter: &Painter, points: Vec<Pos2>, stroke: Stroke) {
    let ends = points.iter().zip(points.iter().cycle().skip(1));
    painter.extend(ends.map(|(&a, &b)| Shape::line_segment([a, b], stroke)));
}

/// A point of the screen on a page, mm.
pub fn to_mm(page: Rect, scale: f32, at: Pos2) -> DVec2 {
    DVec2::new(f64::from((at.x - page.left()) / scale), f64::from((page.bottom() - at.y) / scale))
}

/// A point of a page, mm, on the screen.
pub fn to_screen(page: Rect, scale: f32, at: DVec2) -> Pos2 {
    egui::pos2(page.left() + scale * at.x as f32, page.bottom() - scale * at.y as f32)
}

/// As many columns as make the pages largest when all are shown.
fn columns(count: usize, size_mm: Vec2, window: Vec2) -> usize {
    let step = size_mm + Vec2::splat(GAP_MM);
    let scale = |columns: usize| {
        let rows = count.div_ceil(columns);
        (window.x / (step.x * columns as f32)).min(window.y / (step.y * rows as f32))
    };
    (1..=count.max(1)).max_by(|&a, &b| scale(a).total_cmp(&scale(b)).then(b.cmp(&a))).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{pos2, vec2};

    const A4: Vec2 = Vec2::new(210.0, 297.0);

    #[test]
    fn all_pages_are_in_the_window_at_first_and_none_overlap() {
        for (count, width, height) in
            [(1, 500.0, 700.0), (5, 1200.0, 400.0), (5, 300.0, 900.0), (40, 600.0, 600.0)]
        {
            let window = Rect::from_min_size(pos2(7.0, 9.0), vec2(width, height));
            let seen = Canvas::default().seen(count, A4, window);
            assert_eq!(seen.pages.len(), count);
            for (k, page) in seen.pages.iter().enumerate() {
                assert!(window.expand(0.01).contains_rect(*page), "{page:?}");
                assert!(seen.pages[..k].iter().all(|other| !other.intersects(*page)));
            }
        }
    }

    #[test]
    fn what_is_under_the_pointer_stays_there() {
        let window = Rect::from_min_size(pos2(100.0, 50.0), vec2(600.0, 500.0));
        let mut canvas = Canvas::default();
        let before = canvas.seen(3, A4, window);
        let at = before.pages[1].center() + vec2(13.0, 31.0);
        let on_page = |seen: &Seen| (at - seen.pages[1].min) / seen.scale;
        let place = on_page(&before);
        canvas.zoom(&before, window, 3.0, at);
        let after = canvas.seen(3, A4, window);
        assert!((after.scale / before.scale - 3.0).abs() < 1e-4);
        assert!((on_page(&after) - place).length() < 1e-3);
        canvas.pan(&after, vec2(5.0, -4.0));
        let moved = canvas.seen(3, A4, window);
        assert!((moved.pages[0].min - after.pages[0].min - vec2(5.0, -4.0)).length() < 1e-3);
    }
}
