//! Generated code against the closed form it was traced from: bit for bit at level `exact`, to
//! rounding at level `fast`, in every instruction set; and parameters that a routine takes for
//! granted are never read.

use nboom_formulation::{Coordinates, Layout, Parameters, articulated};
use nboom_model::{Shape, Topology};
use nboom_scalar::{Kernel, Lanes, Routine};

#[allow(missing_docs)]
mod exact {
    include!(concat!(env!("OUT_DIR"), "/exact.rs"));
}

/// Numbers that look random and are the same everywhere.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }
}

/// Parameters of a satellite whose mass matrix is positive: light links on a heavy main body,
/// every inertia well above what its first moment demands.
fn parameters(topology: &Topology, pinned: &[(usize, f64)], numbers: &mut Numbers) -> Vec<f64> {
    let mut all = body(100.0, numbers);
    for shape in topology.shapes() {
        let rot = nboom_scalar::Mat3::from_euler_121(
            numbers.within(-3.0, 3.0),
            numbers.within(-3.0, 3.0),
            numbers.within(-3.0, 3.0),
        );
        all.extend(rot.rows.into_iter().flat_map(nboom_scalar::Vec3::to_array));
        all.extend((0..3).map(|_| numbers.within(-1.0, 1.0)));
        for _ in 0..shape.hinges() {
            all.extend(body(1.0, numbers));
            all.extend((0..2).map(|_| numbers.within(0.2, 1.0)));
        }
    }
    for &(i, value) in pinned {
        all[i] = value;
    }
    all
}

fn body(mass: f64, numbers: &mut Numbers) -> Vec<f64> {
    let mut body = vec![mass * numbers.within(1.0, 2.0)];
    body.extend((0..3).map(|_| mass * numbers.within(-0.3, 0.3)));
    body.extend((0..3).map(|_| mass * numbers.within(1.5, 2.0)));
    body.extend((0..3).map(|_| mass * numbers.within(-0.1, 0.1)));
    body
}

fn state(topology: &Topology, external: bool, numbers: &mut Numbers) -> Vec<f64> {
    let count = Layout::coordinates(topology);
    let mut state: Vec<f64> = (0..count).map(|_| numbers.within(-2.0, 2.0)).collect();
    if !external {
        state[3..9].fill(0.0);
    }
    state
}

fn closed_form(topology: &Topology, parameters: &[f64], state: &[f64]) -> Vec<f64> {
    let satellite = Parameters::read(topology, parameters.iter().copied());
    articulated::solve(topology, &satellite, &Coordinates::read(topology, state)).write(topology)
}

fn generated<T: Routine>(parameters: &[f64], state: &[f64]) -> Vec<f64> {
    let (mut constants, mut out) = (vec![0.0; T::CONSTANTS], vec![0.0; T::OUTPUTS]);
    T::prepare(parameters, &mut constants);
    T::evaluate(&constants, state, &mut out);
    out
}

fn is_the_closed_form<T: Routine>(shapes: &[Shape]) {
    let topology = Topology::new(shapes.iter().copied());
    assert_eq!(T::TOPOLOGY, topology.to_string());
    let mut numbers = Numbers(1970);
    for case in 0..100 {
        let parameters = parameters(&topology, T::PINNED, &mut numbers);
        let state = state(&topology, T::EXTERNAL, &mut numbers);
        let expected = closed_form(&topology, &parameters, &state);
        assert_eq!(generated::<T>(&parameters, &state), expected, "{} case {case}", T::TOPOLOGY);
    }
}

#[test]
fn exact_code_is_the_closed_form_bit_for_bit() {
    use Shape::{Chain, Paddle};
    is_the_closed_form::<exact::StraightS2P>(&[Chain(2), Paddle]);
    is_the_closed_form::<exact::PrincipalS1P>(&[Chain(1), Paddle]);
    is_the_closed_form::<exact::RolledS3>(&[Chain(3); 4]);
    is_the_closed_form::<exact::RolledP>(&[Paddle; 3]);
    is_the_closed_form::<exact::RolledS30>(&[Chain(30)]);
    is_the_closed_form::<exact::RolledMixed>(&[Chain(4), Chain(4), Chain(2), Paddle, Paddle]);
}

#[test]
fn lanes_hold_independent_states() {
    type T = exact::RolledMixed;
    let topology = Topology::new([
        Shape::Chain(4),
        Shape::Chain(4),
        Shape::Chain(2),
        Shape::Paddle,
        Shape::Paddle,
    ]);
    let mut numbers = Numbers(7);
    let parameters = parameters(&topology, T::PINNED, &mut numbers);
    let states: Vec<Vec<f64>> = (0..8).map(|_| state(&topology, false, &mut numbers)).collect();
    let wide = |values: &dyn Fn(usize) -> f64| Lanes::<8>(std::array::from_fn(values));
    let p: Vec<Lanes<8>> = parameters.iter().map(|&value| wide(&|_| value)).collect();
    let x: Vec<Lanes<8>> = (0..T::COORDINATES).map(|i| wide(&|lane| states[lane][i])).collect();
    let zero = wide(&|_| 0.0);
    let (mut k, mut out) = (vec![zero; T::CONSTANTS], vec![zero; T::OUTPUTS]);
    T::prepare(&p, &mut k);
    T::evaluate(&k, &x, &mut out);
    for (lane, state) in states.iter().enumerate() {
        for (found, expected) in out.iter().zip(closed_form(&topology, &parameters, state)) {
            // Lanes take their sines from a polynomial, which differs in the last place.
            assert!((found.0[lane] - expected).abs() < 1e-11 * (1.0 + expected.abs()));
        }
    }
}

#[test]
fn what_a_routine_takes_for_granted_is_never_read() {
    type T = exact::PrincipalS1P;
    let topology = Topology::new([Shape::Chain(1), Shape::Paddle]);
    let mut numbers = Numbers(3);
    let mut parameters = parameters(&topology, T::PINNED, &mut numbers);
    let state = state(&topology, false, &mut numbers);
    let expected = generated::<T>(&parameters, &state);
    for &(i, _) in T::PINNED {
        parameters[i] = f64::NAN;
    }
    assert_eq!(generated::<T>(&parameters, &state), expected);
    assert!(!T::PINNED.is_empty());
}

/// The shapes that a topology's name stands for.
fn shapes(name: &str) -> Vec<Shape> {
    let shape = |text: &str| match text {
        "P" => Shape::Paddle,
        chain => Shape::Chain(chain[1..].parse().expect("a chain has a length")),
    };
    let group = |text: &str| match text.split_once('x') {
        Some((count, of)) => vec![shape(of); count.parse().expect("a count")],
        None => vec![shape(text)],
    };
    name.split('_').filter(|text| *text != "M").flat_map(group).collect()
}

#[test]
fn stock_routines_agree_with_the_closed_form_in_this_processors_code() {
    let kernels: &[Kernel] = nboom_routines::all();
    assert!(kernels.len() > 20);
    for kernel in kernels {
        let topology = Topology::new(shapes(kernel.topology));
        assert_eq!(topology.to_string(), kernel.topology);
        let mut numbers = Numbers(11);
        for case in 0..50 {
            let parameters = parameters(&topology, kernel.pinned, &mut numbers);
            assert!(kernel.accepts(&parameters));
            let state = state(&topology, kernel.external, &mut numbers);
            let (mut constants, mut found) =
                (vec![0.0; kernel.constants], vec![0.0; kernel.outputs]);
            kernel.prepare(&parameters, &mut constants);
            kernel.evaluate(&constants, &state, &mut found);
            let expected = closed_form(&topology, &parameters, &state);
            let scale = expected.iter().fold(1.0_f64, |m, e| m.max(e.abs()));
            for (found, expected) in found.iter().zip(&expected) {
                // Fused and regrouped rounding, on mass matrices of condition up to 1e3.
                assert!((found - expected).abs() < 1e-12 * scale, "{} {case}", kernel.topology);
            }
        }
    }
}

#[test]
fn a_parameter_that_breaks_what_is_taken_for_granted_is_not_accepted() {
    for kernel in nboom_routines::all().iter().filter(|kernel| !kernel.pinned.is_empty()) {
        let topology = Topology::new(shapes(kernel.topology));
        let mut parameters = parameters(&topology, kernel.pinned, &mut Numbers(5));
        parameters[kernel.pinned[0].0] += 1e-12;
        assert!(!kernel.accepts(&parameters));
        assert!(!kernel.accepts(&parameters[1..]));
    }
}
