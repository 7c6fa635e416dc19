use super::*;

#[inline(always)]
fn exp_of<S: Simd, const T: usize>(s: S, x: &Lanes, y: &mut Lanes) {
    for at in (0..LANES).step_by(S::WIDTH) {
        let v = s.exp(s.load(&x.0, at));
        s.store(&mut y.0, at, v);
    }
}
kernel! { fn exp_kernel(x: &Lanes, y: &mut Lanes) = exp_of }

#[test]
fn the_exponential_is_right_on_every_instruction_set() {
    let mut x = Lanes::ZERO;
    for (i, x) in x.0.iter_mut().enumerate() {
        *x = (i as f32 - 32.0) * 2.5 + 0.1;
    }
    for set in InstructionSet::available() {
        let mut y = Lanes::ZERO;
        exp_kernel(set, &x, &mut y);
        for (x, y) in x.0.iter().zip(y.0) {
            let exact = f64::from(*x).exp();
            assert!((f64::from(y) / exact - 1.0).abs() < 1e-6, "{}: exp({x}) = {y}", set.name());
        }
    }
}

#[inline(always)]
fn pair_round_trip<S: Simd, const T: usize>(s: S, table: &[f32; 8], out: &mut [f32; 24]) {
    // SAFETY: the table has eight floats, and so has the part of `out` from 8 on and from 16 on.
    unsafe {
        let pair =
            s.fma_pair(s.load_pair(table.as_ptr()), 2.0, s.scale_pair(s.load_pair(table.as_ptr()), 0.5));
        let quad = s.blend_halves(pair, 0.25);
        s.store_quad(out, 0, quad);
        s.add_to_pair(out.as_mut_ptr().add(8), 3.0, s.spread_halves(quad, 0.25));
    }
    let rows = [0, 1, 2, 3].map(|i| s.load_quad(table, i));
    let columns = s.transpose(rows);
    s.store_quad(out, 16, columns[0]);
    s.store_quad(out, 20, columns[3]);
}
kernel! { fn pair_kernel(table: &[f32; 8], out: &mut [f32; 24]) = pair_round_trip }

#[test]
fn entry_pairs_blend_spread_and_transpose_alike_on_every_instruction_set() {
    let table = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    for set in InstructionSet::available() {
        let mut out = [0.0; 24];
        pair_kernel(set, &table, &mut out);
        assert_eq!(out[..4], [5.0, 7.5, 10.0, 12.5], "{}", set.name());
        assert_eq!(out[8..12], [11.25, 16.875, 22.5, 28.125]);
        assert_eq!(out[12..16], [3.75, 5.625, 7.5, 9.375]);
        assert_eq!(out[16..], [1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 6.0, 7.0]);
    }
}
