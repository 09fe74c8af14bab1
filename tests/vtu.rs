//! Fields for ParaView: the files are read back and the Bezier cells evaluated as VTK does.
//!
//! The reader below knows the format from VTK's documentation, not from the writer. The same annulus opened with VTK
//! 9.7.2 itself (`tests/vtu_exact.py`, run by hand) has a radius error of 6.7e-16.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity::geometry::{BSpline, Basis, Curve, Lagrange, Patch, Point};
use asperity::output::RunFolder;
use asperity::output::vtu::{BodyField, CauchySample, write_vtu};

/// A `.vtu` file as a reader sees it.
struct File {
    text: String,
}

impl File {
    fn read(path: &Path) -> Self {
        Self { text: fs::read_to_string(path).unwrap() }
    }

    /// Little-endian 8-byte words of an array after its length word; single bytes for `types`.
    fn bytes(&self, name: &str) -> Vec<u8> {
        let (_, rest) = self.text.split_once(&format!("Name=\"{name}\"")).expect(name);
        let (_, rest) = rest.split_once(">\n").unwrap();
        let bytes = decode(rest.split_once('\n').unwrap().0);
        let length = u64::from_le_bytes(bytes[..8].try_into().unwrap()) as usize;
        assert_eq!(length, bytes.len() - 8, "length word of {name}");
        bytes[8..].to_vec()
    }

    fn floats(&self, name: &str) -> Vec<f64> {
        self.bytes(name).chunks(8).map(|word| f64::from_le_bytes(word.try_into().unwrap())).collect()
    }

    fn integers(&self, name: &str) -> Vec<usize> {
        self.bytes(name).chunks(8).map(|word| i64::from_le_bytes(word.try_into().unwrap()) as usize).collect()
    }

    /// A field with `width` components in one cell at local coordinates, by de Casteljau in homogeneous coordinates.
    fn evaluate(&self, field: &str, width: usize, cell: usize, at: [f64; 2]) -> Vec<f64> {
        let offsets = self.integers("offsets");
        let connectivity = self.integers("connectivity");
        let start = if cell == 0 { 0 } else { offsets[cell - 1] };
        let nodes = &connectivity[start..offsets[cell]];
        let degrees: Vec<usize> =
            self.floats("HigherOrderDegrees")[3 * cell..3 * cell + 2].iter().map(|p| *p as usize).collect();
        let (weights, values) = (self.floats("RationalWeights"), self.floats(field));
        let mut net = vec![vec![0.0; width + 1]; (degrees[0] + 1) * (degrees[1] + 1)];
        for (node, (a, b)) in nodes.iter().zip(documented_order(degrees[0], degrees[1])) {
            let weight = weights[*node];
            let entry = &mut net[a + b * (degrees[0] + 1)];
            for c in 0..width {
                entry[c] = weight * values[width * node + c];
            }
            entry[width] = weight;
        }
        let rows = net.chunks(degrees[0] + 1).map(|row| casteljau(row.to_vec(), at[0])).collect();
        let mut point = casteljau(rows, at[1]);
        let weight = point.pop().unwrap();
        point.into_iter().map(|value| value / weight).collect()
    }
}

fn casteljau(mut net: Vec<Vec<f64>>, t: f64) -> Vec<f64> {
    while net.len() > 1 {
        net = net
            .windows(2)
            .map(|pair| pair[0].iter().zip(&pair[1]).map(|(a, b)| (1.0 - t) * a + t * b).collect())
            .collect();
    }
    net.remove(0)
}

/// Point order of VTK's Bezier quadrilateral (and, with `q = 0`, curve).
fn documented_order(p: usize, q: usize) -> Vec<(usize, usize)> {
    if q == 0 {
        return [0, p].into_iter().chain(1..p).map(|a| (a, 0)).collect();
    }
    let mut order = vec![(0, 0), (p, 0), (p, q), (0, q)];
    order.extend((1..p).map(|a| (a, 0)));
    order.extend((1..q).map(|b| (p, b)));
    order.extend((1..p).map(|a| (a, q)));
    order.extend((1..q).map(|b| (0, b)));
    for b in 1..q {
        order.extend((1..p).map(|a| (a, b)));
    }
    order
}

fn decode(text: &str) -> Vec<u8> {
    let value = |letter: u8| match letter {
        b'A'..=b'Z' => u32::from(letter - b'A'),
        b'a'..=b'z' => u32::from(letter - b'a') + 26,
        b'0'..=b'9' => u32::from(letter - b'0') + 52,
        b'+' => 62,
        b'/' => 63,
        _ => 0,
    };
    let mut bytes = Vec::new();
    for block in text.as_bytes().chunks(4) {
        let bits = block.iter().fold(0, |bits, letter| bits << 6 | value(*letter));
        let padding = block.iter().filter(|letter| **letter == b'=').count();
        bytes.extend_from_slice(&bits.to_be_bytes()[1..4 - padding]);
    }
    bytes
}

/// Quarter annulus, radii 1 and 2: rational quadratic in the angle (u), linear in the radius (v), 3 x 2 elements.
fn annulus() -> Patch {
    let corner = 0.5_f64.sqrt();
    let ring = [([1.0, 0.0], 1.0), ([1.0, 1.0], corner), ([0.0, 1.0], 1.0)];
    let points = [1.0, 2.0].into_iter().flat_map(|r| ring.map(|(p, _)| r * Point::from(p))).collect();
    let whole = Patch {
        basis: [spline(2, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0]), spline(1, &[0.0, 0.0, 1.0, 1.0])],
        weights: [ring, ring].concat().into_iter().map(|(_, weight)| weight).collect(),
        points,
    };
    [(0, 0.3), (0, 0.8), (1, 0.4)]
        .into_iter()
        .fold(whole, |patch, (direction, knot)| patch.insert_knot(direction, knot).unwrap())
}

fn spline(degree: usize, knots: &[f64]) -> Arc<dyn Basis> {
    Arc::new(BSpline::new(degree, knots.to_vec()).unwrap())
}

/// Uneven cubic by quadratic patch with a double knot and weights between 0.5 and 1.5.
fn wavy() -> Patch {
    let basis = [
        spline(3, &[0.0, 0.0, 0.0, 0.0, 0.2, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0]),
        spline(2, &[0.0, 0.0, 0.0, 0.7, 2.0, 2.0, 2.0]),
    ];
    let (nu, nv) = (basis[0].len(), basis[1].len());
    let node = |k: usize| (k % nu, k / nu);
    Patch {
        weights: (0..nu * nv).map(|k| 1.0 + 0.5 * (3.7 * k as f64).sin()).collect(),
        points: (0..nu * nv)
            .map(|k| {
                let (i, j) = node(k);
                Point::new(i as f64 + 0.2 * (k as f64).cos(), j as f64 + 0.3 * (2.0 * k as f64).sin())
            })
            .collect(),
        basis,
    }
}

fn lagrange(degree: usize) -> Patch {
    let basis: [Arc<dyn Basis>; 2] = [[0.0, 0.5, 2.0], [0.0, 0.25, 1.0]]
        .map(|breaks| Arc::new(Lagrange::new(degree, breaks.to_vec()).unwrap()) as Arc<dyn Basis>);
    let (u, v) = (basis[0].nodes(), basis[1].nodes());
    let points: Vec<Point> = v.iter().flat_map(|v| u.iter().map(move |u| Point::new(u + v * v, v - 0.1 * u))).collect();
    Patch { weights: vec![1.0; points.len()], points, basis }
}

/// Position-dependent stress that the rational space of the patch contains: the coordinates themselves.
fn field<'a>(patch: &'a Patch, displacement: &'a [Point]) -> BodyField<'a> {
    let stress = |element, uv| {
        let (x, _) = patch.map(element, uv);
        CauchySample { stress: [x.x, x.y, 2.0, -x.x], det_f: 3.0 * x.y }
    };
    BodyField::Deformable { name: "body", patch, displacement, stress: Box::new(stress) }
}

fn displaced(patch: &Patch) -> Vec<Point> {
    patch.points.iter().map(|p| Point::new(0.1 * p.y, p.x * p.y)).collect()
}

fn scratch(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("asperity-vtu-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn write(patch: &Patch, name: &str) -> File {
    let path = scratch(name).join("body.vtu");
    write_vtu(&path, 0.5, &[field(patch, &displaced(patch))]).unwrap();
    File::read(&path)
}

#[test]
fn quarter_annulus_is_exact() {
    // ASPERITY_VTU_OUT keeps the file for tests/vtu_exact.py.
    let patch = annulus();
    let file = write(&patch, "annulus");
    if let Ok(kept) = std::env::var("ASPERITY_VTU_OUT") {
        fs::write(kept, &file.text).unwrap();
    }
    let cells = file.bytes("types");
    assert_eq!(cells, vec![77; 6]);
    let mut worst = 0.0_f64;
    for cell in 0..cells.len() {
        let [_, [v0, v1]] = patch.span_box([cell % 3, cell / 3]);
        for k in 0..=100 {
            let at = [f64::from(k % 11) / 10.0, f64::from(k / 11) / 10.0];
            let x = file.evaluate("Points", 3, cell, at);
            let radius = 1.0 + v0 + at[1] * (v1 - v0);
            worst = worst.max((x[0].hypot(x[1]) - radius).abs());
        }
    }
    println!("quarter annulus: radius error {worst:e}");
    assert!(worst < 1e-14, "{worst:e}");
}

#[test]
fn cells_reproduce_patch_and_fields() {
    for (patch, name) in [(wavy(), "wavy"), (lagrange(1), "p1"), (lagrange(2), "p2"), (annulus(), "fields")] {
        let (file, displacement) = (write(&patch, name), displaced(&patch));
        let [nu, nv] = patch.elements();
        assert_eq!(file.integers("offsets").len(), nu * nv);
        for cell in 0..nu * nv {
            let element = [cell % nu, cell / nu];
            let [[u0, u1], [v0, v1]] = patch.span_box(element);
            for at in [[0.0, 0.0], [1.0, 0.0], [0.3, 0.9], [0.62, 0.41], [1.0, 1.0]] {
                let uv = [u0 + at[0] * (u1 - u0), v0 + at[1] * (v1 - v0)];
                let shape = patch.shape(element, uv);
                let sum = |of: &[Point]| -> Point {
                    shape.nodes.iter().zip(&shape.values).map(|(node, value)| of[*node] * *value).sum()
                };
                let (x, u) = (sum(&patch.points), sum(&displacement));
                let near = |field: &str, exact: &[f64]| {
                    for (found, exact) in file.evaluate(field, exact.len(), cell, at).iter().zip(exact) {
                        assert!((found - exact).abs() < 1e-13 * 20.0, "{name} {field} {cell}: {found} {exact}");
                    }
                };
                near("Points", &[x.x, x.y, 0.0]);
                near("displacement", &[u.x, u.y, 0.0]);
                near("cauchy_stress", &[x.x, x.y, 2.0, -x.x]);
                near("det_f", &[3.0 * x.y]);
            }
        }
    }
}

#[test]
fn rigid_bodies_are_curve_cells() {
    let patch = annulus();
    let curve: Curve = patch.boundary(asperity::geometry::Edge::Top);
    let still = vec![Point::new(0.0, 1.0); curve.points.len()];
    let path = scratch("rigid").join("rigid.vtu");
    write_vtu(&path, 0.0, &[BodyField::Rigid { name: "indenter", curve: &curve, displacement: &still }]).unwrap();
    let file = File::read(&path);
    assert_eq!(file.bytes("types"), vec![75; 3]);
    for cell in 0..3 {
        for k in 0..=10 {
            let at = [f64::from(k) / 10.0, 0.0];
            let x = file.evaluate("Points", 3, cell, at);
            assert!((x[0].hypot(x[1]) - 2.0).abs() < 1e-14);
            assert!((file.evaluate("displacement", 3, cell, at)[1] - 1.0).abs() < 1e-15);
        }
    }
    assert!(file.floats("von_mises").iter().all(|value| value.is_nan()));
}

#[test]
fn collection_survives_restart() {
    let root = scratch("series");
    let folder = RunFolder::create(&root).unwrap();
    let patch = annulus();
    let displacement = displaced(&patch);
    let bodies = || [field(&patch, &displacement)];
    let mut series = folder.fields(None).unwrap();
    for step in [10, 20, 30] {
        series.append(step, step as f64 / 3.0, &bodies()).unwrap();
    }
    let mut series = folder.fields(Some(20)).unwrap();
    assert!(!root.join("fields/step_000030.vtu").exists());
    series.append(25, 0.1 + 0.2, &bodies()).unwrap();
    let listed = fs::read_to_string(root.join("fields.pvd")).unwrap();
    let files: Vec<_> = listed.lines().filter(|line| line.contains("DataSet")).collect();
    assert_eq!(files.len(), 3);
    assert!(files[2].contains("timestep=\"0.30000000000000004\"") && files[2].contains("step_000025.vtu"));
    assert!(root.join("fields/step_000025.vtu").exists());
}
