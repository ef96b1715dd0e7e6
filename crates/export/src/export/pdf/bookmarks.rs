//! Bookmarks: one for each component, and below it one for each of its pieces where there are
//! several. Each leads to the page and the place of its piece.

use super::Leaf;
use super::page::PT_PER_MM;
use glam::DVec2;
use lopdf::{Dictionary, Document, Object, ObjectId, text_string};
use tatamu_core::geom::polygon;
use tatamu_draw::drawing::{Mark, Pages};

/// Free space round a piece when a bookmark shows it, mm.
const AROUND_MM: f64 = 5.0;

/// An entry that leads to a page.
struct Bookmark {
    title: String,
    destination: Vec<Object>,
    below: Vec<Bookmark>,
}

/// Adds the bookmarks of all components that have pieces on pages. `ids` are the pages' objects.
pub(super) fn add(
    document: &mut Document,
    pages: &Pages,
    leaves: &[Leaf],
    ids: &[ObjectId],
) -> Result<(), lopdf::Error> {
    let entry = |title: &str, piece: &str| {
        let destination = destination(piece, pages, leaves, ids)?;
        Some(Bookmark { title: title.to_owned(), destination, below: Vec::new() })
    };
    let chapter = |name: &str, pieces: &[String]| {
        let below: Vec<Bookmark> = pieces.iter().filter_map(|piece| entry(piece, piece)).collect();
        let destination = below.first()?.destination.clone();
        let below = if below.len() > 1 { below } else { Vec::new() };
        Some(Bookmark { title: name.to_owned(), destination, below })
    };
    let chapters = pages.chapters().iter();
    let entries: Vec<Bookmark> = chapters.filter_map(|c| chapter(&c.name, &c.pieces)).collect();
    if entries.is_empty() {
        return Ok(());
    }
    let root = document.new_object_id();
    let mut dictionary = Dictionary::from_iter([("Type", Object::from("Outlines"))]);
    let count = entries.len() as i64;
    push(document, &mut dictionary, root, &entries);
    dictionary.set("Count", count);
    document.objects.insert(root, Object::Dictionary(dictionary));
    document.catalog_mut()?.set("Outlines", Object::Reference(root));
    Ok(())
}

/// Adds entries as objects below `parent`, whose dictionary gets its first and last one.
fn push(document: &mut Document, parent: &mut Dictionary, parent_id: ObjectId, entries: &[Bookmark]) {
    let ids: Vec<ObjectId> = entries.iter().map(|_| document.new_object_id()).collect();
    for (k, entry) in entries.iter().enumerate() {
        let mut item = Dictionary::from_iter([
            ("Title", text_string(&entry.title)),
            ("Parent", Object::Reference(parent_id)),
            ("Dest", Object::Array(entry.destination.clone())),
        ]);
        if k > 0 {
            item.set("Prev", Object::Reference(ids[k - 1]));
        }
        if let Some(&next) = ids.get(k + 1) {
            item.set("Next", Object::Reference(next));
        }
        if !entry.below.is_empty() {
            push(document, &mut item, ids[k], &entry.below);
            // Closed, which is what a negative count means.
            item.set("Count", -(entry.below.len() as i64));
        }
        document.objects.insert(ids[k], Object::Dictionary(item));
    }
    if let [first, .., last] | [first @ last] = ids[..] {
        parent.set("First", Object::Reference(first));
        parent.set("Last", Object::Reference(last));
    }
}

/// The rectangle of a piece on the page that holds its middle.
fn destination(piece: &str, pages: &Pages, leaves: &[Leaf], ids: &[ObjectId]) -> Option<Vec<Object>> {
    let is_of_piece = |mark: &&Mark| mark.piece.as_deref() == Some(piece);
    let (drawing, (low, high)) = pages.drawings().iter().enumerate().find_map(|(k, drawing)| {
        let bounds = drawing.marks.iter().filter(is_of_piece).filter_map(Mark::bounds);
        Some((k, polygon::bounds(bounds.flat_map(|(low, high)| [low, high]))?))
    })?;
    let middle = low.midpoint(high);
    let on_drawing = || leaves.iter().zip(ids).filter(|(leaf, _)| leaf.drawing == drawing);
    let (leaf, id) = on_drawing().find(|(leaf, _)| leaf.holds(middle)).or_else(|| on_drawing().next())?;
    let around = DVec2::splat(AROUND_MM);
    let corners = [low - around, high + around].map(|p| (p + leaf.shift_mm()) * PT_PER_MM);
    let numbers = corners.iter().flat_map(|p| [p.x, p.y]).map(|value| Object::Real(value as f32));
    Some([Object::Reference(*id), Object::from("FitR")].into_iter().chain(numbers).collect())
}
