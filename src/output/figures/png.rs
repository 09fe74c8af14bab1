//! SVG to PNG without any font of the machine: DejaVu Sans is part of the program.

use std::path::Path;
use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use crate::output::OutputError;

/// Resolution of the PNGs, dots per inch.
pub const DPI: f64 = 400.0;

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.load_font_data(dejavu::sans::oblique().to_vec());
    Arc::new(fonts)
});

/// Renders an SVG document of ours at [`DPI`]; `path` is only named in errors.
///
/// # Errors
/// What the renderer says: malformed SVG or a picture without extent.
pub fn render(svg: &str, path: &Path) -> Result<Vec<u8>, OutputError> {
    let fail = |reason: String| OutputError::Figure { path: path.to_path_buf(), reason };
    let options = Options { fontdb: FONTS.clone(), dpi: 72.0, font_family: "DejaVu Sans".into(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|error| fail(error.to_string()))?;
    let scale = (DPI / 72.0) as f32;
    let (width, height) = (tree.size().width() * scale, tree.size().height() * scale);
    let mut pixmap = Pixmap::new(width.ceil() as u32, height.ceil() as u32).ok_or_else(|| fail("no extent".into()))?;
    // The last row and column reach beyond the sheet: white there too, not half transparent.
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| fail(error.to_string()))
}
