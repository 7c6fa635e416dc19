mod scene;
mod training;
