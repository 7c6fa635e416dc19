mod gradients;
mod scene;
mod training;
