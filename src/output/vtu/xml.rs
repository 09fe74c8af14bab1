//! The XML of a `.vtu` file: inline base64 arrays, little endian, 64-bit lengths.

use std::fmt::Write;
use std::path::Path;

use super::base64::encode;
use super::{BodyField, Grid};
use crate::output::OutputError;
use crate::output::run_json::write_atomic;

/// Writes all bodies at one instant as rational Bezier cells.
///
/// # Errors
/// The path and the operating system's reason; an existing file stays whole.
pub fn write_vtu(path: &Path, time: f64, bodies: &[BodyField]) -> Result<(), OutputError> {
    write_atomic(path, document(&Grid::build(bodies), time, bodies).as_bytes())
}

fn document(grid: &Grid, time: f64, bodies: &[BodyField]) -> String {
    let mut xml = String::from("<?xml version=\"1.0\"?>\n");
    // Body names are free text and "--" may not occur in a comment.
    let names = bodies.iter().map(|body| body.name().replace("--", "- -")).collect::<Vec<_>>().join(", ");
    let _ = writeln!(xml, "<!-- body 0, 1, ...: {names} -->");
    xml.push_str(
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
    );
    xml.push_str("<UnstructuredGrid>\n<FieldData>\n");
    array(&mut xml, "Float64", "TimeValue", "NumberOfTuples=\"1\"", &floats([time]));
    let (points, cells) = (grid.points.len(), grid.types.len());
    let _ = writeln!(xml, "</FieldData>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">");
    geometry(&mut xml, grid);
    point_data(&mut xml, grid);
    cell_data(&mut xml, grid);
    xml.push_str("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    xml
}

fn geometry(xml: &mut String, grid: &Grid) {
    xml.push_str("<Points>\n");
    array(xml, "Float64", "Points", "NumberOfComponents=\"3\"", &floats(flat(&grid.points)));
    xml.push_str("</Points>\n<Cells>\n");
    array(xml, "Int64", "connectivity", "", &integers(0..grid.points.len()));
    array(xml, "Int64", "offsets", "", &integers(grid.offsets.iter().copied()));
    array(xml, "UInt8", "types", "", &grid.types);
    xml.push_str("</Cells>\n");
}

fn point_data(xml: &mut String, grid: &Grid) {
    xml.push_str("<PointData RationalWeights=\"RationalWeights\" Scalars=\"von_mises\" Vectors=\"displacement\">\n");
    let scalar = "NumberOfComponents=\"1\"";
    array(xml, "Float64", "RationalWeights", scalar, &floats(grid.weights.iter().copied()));
    array(xml, "Float64", "displacement", "NumberOfComponents=\"3\"", &floats(flat(&grid.displacement)));
    let stress = "NumberOfComponents=\"4\" ComponentName0=\"xx\" ComponentName1=\"yy\" ComponentName2=\"zz\" ComponentName3=\"xy\"";
    array(xml, "Float64", "cauchy_stress", stress, &floats(flat(&grid.stress)));
    array(xml, "Float64", "von_mises", scalar, &floats(grid.von_mises.iter().copied()));
    array(xml, "Float64", "det_f", scalar, &floats(grid.det_f.iter().copied()));
    xml.push_str("</PointData>\n");
}

fn cell_data(xml: &mut String, grid: &Grid) {
    xml.push_str("<CellData HigherOrderDegrees=\"HigherOrderDegrees\">\n");
    let degrees = grid.degrees.iter().flat_map(|[p, q]| [*p as f64, *q as f64, 0.0]);
    array(xml, "Float64", "HigherOrderDegrees", "NumberOfComponents=\"3\"", &floats(degrees));
    array(xml, "Int64", "body", "", &integers(grid.body.iter().copied()));
    xml.push_str("</CellData>\n");
}

fn array(xml: &mut String, kind: &str, name: &str, attributes: &str, bytes: &[u8]) {
    let mut block = (bytes.len() as u64).to_le_bytes().to_vec();
    block.extend_from_slice(bytes);
    let text = encode(&block);
    let _ = writeln!(
        xml,
        "<DataArray type=\"{kind}\" Name=\"{name}\" {attributes} format=\"binary\">\n{text}\n</DataArray>"
    );
}

fn floats(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    values.into_iter().flat_map(f64::to_le_bytes).collect()
}

fn integers(values: impl IntoIterator<Item = usize>) -> Vec<u8> {
    values.into_iter().flat_map(|value| (value as i64).to_le_bytes()).collect()
}

fn flat<const N: usize>(rows: &[[f64; N]]) -> impl Iterator<Item = f64> {
    rows.iter().flatten().copied()
}
