//! Gradients against finite differences, and every instruction set against the portable one.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::nerf::InstructionSet;
use crate::nerf::composite::{Pixel, PixelGradient, composite, composite_backward};
use crate::nerf::field::{
    Block, DensityBlock, Field, GEOMETRY, Gradients, backward, density, forward, spherical_harmonics,
};
use crate::nerf::simd::{LANES, Line, flat, flat_mut};

const STEP: f32 = 0.05;
const RAYS: usize = 9;
const SAMPLES: usize = 100;

/// A field with strong, uneven parameters, and samples of a few rays in it.
struct Case {
    field: Field,
    positions: Vec<DensityBlock>,
    targets: Vec<([f32; 3], [f32; 3])>,
}

fn case() -> Case {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut field = Field::new(15, &mut rng);
    for x in flat_mut(&mut field.grid.table) {
        *x = rng.random_range(-0.7..0.7);
    }
    let mut positions = vec![DensityBlock::EMPTY; SAMPLES.div_ceil(LANES)];
    for i in 0..SAMPLES {
        for axis in &mut positions[i / LANES].position {
            axis.0[i % LANES] = rng.random();
        }
    }
    let targets = (0..RAYS).map(|_| (rng.random(), rng.random())).collect();
    Case { field, positions, targets }
}

/// The loss and the blocks it was computed with.
fn loss(set: InstructionSet, case: &Case) -> (f64, Vec<Block>, Vec<PixelGradient>) {
    let mut found = case.positions.clone();
    density(set, &case.field, STEP, &mut found, SAMPLES);
    let mut blocks = vec![Block::EMPTY; found.len()];
    for (b, (block, found)) in blocks.iter_mut().zip(&found).enumerate() {
        block.position = found.position;
        block.features = found.features;
        block.used = (SAMPLES - b * LANES).min(LANES);
        for i in 0..block.used {
            let ray = (b * LANES + i) % RAYS;
            block.ray[i] = ray as u32;
            let angle = ray as f32;
            let harmonics = spherical_harmonics([angle.cos() * 0.6, angle.sin() * 0.6, 0.8]);
            for (row, h) in block.middle[GEOMETRY..].iter_mut().zip(harmonics) {
                row.0[i] = h;
            }
        }
    }
    forward(set, &case.field, STEP, &mut blocks);
    let mut pixels = vec![Pixel::EMPTY; RAYS];
    composite(&blocks, &mut pixels);
    let mut sum = 0.0;
    let gradients = pixels.iter().zip(&case.targets).map(|(pixel, (background, target))| {
        let colour = pixel.over(*background);
        sum += (0..3).map(|c| f64::from(colour[c] - target[c]).powi(2)).sum::<f64>();
        PixelGradient { colour, d_colour: std::array::from_fn(|c| 2.0 * (colour[c] - target[c])) }
    });
    let gradients = gradients.collect();
    (sum, blocks, gradients)
}

/// Gradients of grid, density in, density out, colour in, colour out.
fn analytic(set: InstructionSet, case: &Case) -> [Vec<f32>; 5] {
    let (_, mut blocks, pixels) = loss(set, case);
    composite_backward(&mut blocks, &pixels, &mut [Pixel::EMPTY; RAYS]);
    let mut g = Gradients::new(&case.field);
    backward(set, &case.field, &mut blocks, &mut g);
    for (touched, line) in g.grid.touched.iter().zip(g.grid.table.iter()) {
        assert!(*touched == 1 || line.0 == [0.0; 16], "a line with a gradient is not marked");
    }
    let sum = |lines: &[Line]| lines.iter().map(|line| line.0.iter().sum()).collect();
    [
        flat(&g.grid.table).to_vec(),
        sum(&g.density_in),
        sum(&g.density_out),
        sum(&g.colour_in),
        sum(&g.colour_out),
    ]
}

fn parameters(field: &mut Field, part: usize) -> &mut [Line] {
    match part {
        0 => &mut field.grid.table,
        1 => &mut field.density_in.weights,
        2 => &mut field.density_out.weights,
        3 => &mut field.colour_in.weights,
        _ => &mut field.colour_out.weights,
    }
}

fn loss_with(case: &mut Case, part: usize, index: usize, value: f32) -> f64 {
    flat_mut(parameters(&mut case.field, part))[index] = value;
    let Field { density_in, density_out, colour_in, colour_out, .. } = &mut case.field;
    for layer in [density_in, density_out, colour_in, colour_out] {
        layer.pack();
    }
    loss(InstructionSet::best(), case).0
}

#[test]
fn gradients_of_grid_and_networks_agree_with_finite_differences() {
    let mut case = case();
    let gradients = analytic(InstructionSet::best(), &case);
    for (part, gradient) in gradients.iter().enumerate() {
        // The largest gradients stand out of the rounding of f32 differences.
        let mut order: Vec<usize> = (0..gradient.len()).collect();
        order.sort_by(|&a, &b| gradient[b].abs().total_cmp(&gradient[a].abs()));
        for &index in order.iter().take(24) {
            let at = flat(parameters(&mut case.field, part))[index];
            let difference = |case: &mut Case, h: f32| {
                (loss_with(case, part, index, at + h) - loss_with(case, part, index, at - h))
                    / f64::from(2.0 * h)
            };
            let coarse = difference(&mut case, 4e-3);
            let fine = difference(&mut case, 2e-3);
            loss_with(&mut case, part, index, at);
            let g = f64::from(gradient[index]);
            assert!(g.abs() > 1e-4, "part {part}: no gradient to test, {g}");
            // Rectifiers kink: one of the two widths may straddle one.
            let error = (g - coarse).abs().min((g - fine).abs());
            assert!(error < 0.02 * g.abs() + 2e-4, "part {part} [{index}]: {g} but {coarse}, {fine}");
        }
    }
}

#[test]
fn every_instruction_set_gives_the_gradients_of_the_portable_one() {
    let case = case();
    let expected = analytic(InstructionSet::PORTABLE, &case);
    for set in InstructionSet::available() {
        for (part, (a, b)) in analytic(set, &case).iter().zip(&expected).enumerate() {
            let norm = b.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
            let error = a.iter().zip(b).map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>().sqrt();
            assert!(norm > 0.0 && error < 1e-4 * norm, "{} part {part}: {error} of {norm}", set.name());
        }
    }
}

#[test]
fn gradients_of_compositing_agree_with_finite_differences() {
    let raw = [0.4f32, -0.3, 0.8, 0.1, 1.2];
    let before_sigmoid =
        [[0.3f32, -0.5, 0.9], [1.0, 0.2, -1.0], [-0.4, 0.6, 0.1], [0.0, 2.0, -2.0], [0.7, 0.7, -0.1]];
    let (background, target) = ([0.2f32, 0.9, 0.5], [0.8f32, 0.1, 0.3]);
    let fill = |raw: &[f32; 5], before: &[[f32; 3]; 5]| {
        let mut block = Block::EMPTY;
        block.used = 5;
        for i in 0..5 {
            block.optical_depth.0[i] = 0.2 * (2.0 * raw[i]).exp();
            block.alpha.0[i] = 1.0 - (-block.optical_depth.0[i]).exp();
            for (channel, x) in block.colour.iter_mut().zip(before[i]) {
                channel.0[i] = 1.0 / (1.0 + (-x).exp());
            }
        }
        let mut pixel = [Pixel::EMPTY];
        composite(std::slice::from_ref(&block), &mut pixel);
        let colour = pixel[0].over(background);
        let loss = (0..3).map(|c| f64::from(colour[c] - target[c]).powi(2)).sum::<f64>();
        (loss, block, colour)
    };
    let (_, mut block, colour) = fill(&raw, &before_sigmoid);
    let d_colour = std::array::from_fn(|c| 2.0 * (colour[c] - target[c]));
    let gradient = [PixelGradient { d_colour, colour }];
    composite_backward(std::slice::from_mut(&mut block), &gradient, &mut [Pixel::EMPTY]);
    let h = 1e-2;
    let close = |analytic: f32, plus: f64, minus: f64, what: &str| {
        let numeric = (plus - minus) / (2.0 * f64::from(h));
        assert!((f64::from(analytic) - numeric).abs() < 2e-4, "{what}: {analytic} but {numeric}");
    };
    for i in 0..5 {
        let shifted = |h: f32| {
            let mut raw = raw;
            raw[i] += h;
            fill(&raw, &before_sigmoid).0
        };
        close(block.d_middle[0].0[i], shifted(h), shifted(-h), "density");
        for c in 0..3 {
            let shifted = |h: f32| {
                let mut before = before_sigmoid;
                before[i][c] += h;
                fill(&raw, &before).0
            };
            close(block.d_colour[c].0[i], shifted(h), shifted(-h), "colour");
        }
    }
}
