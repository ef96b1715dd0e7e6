//! What examples are given that draw pictures: inputs, and the picture to write.

/// The inputs, and the name of the PNG file that ends the list; `None` where either lacks: a list without a picture at its
/// end must not cost its last mesh.
pub fn inputs_and_picture(arguments: &[String]) -> Option<(&[String], &String)> {
    let (picture, inputs) = arguments.split_last()?;
    (picture.ends_with(".png") && !inputs.is_empty()).then_some((inputs, picture))
}
