//! Joints between components, their tree, and the model's states.
