//! Parallel projection of a three-dimensional scene to an image.

use glam::DVec3;

/// A parallel projection along one viewing direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    right: DVec3,
    up: DVec3,
    /// Viewing direction: unit vector away from the viewer.
    ahead: DVec3,
    /// Position that is shown at the centre of the image [m].
    centre: DVec3,
    /// Scale of the image [px/m].
    pub scale: f64,
    /// Width and height of the image [px].
    pub size: [f64; 2],
}

impl View {
    /// Creates a view in the direction `ahead` (any length) that shows all `places` [m] in an image of a size [px].
    /// `margin` is the width of the margin divided by the image size. The z axis points upwards in the image; in a view
    /// along z, the y axis points upwards.
    pub fn along(ahead: DVec3, places: impl IntoIterator<Item = DVec3>, size: [f64; 2], margin: f64) -> Self {
        let ahead = ahead.normalize_or(DVec3::Y);
        let upwards = if ahead.z.abs() > 0.999 { DVec3::Y } else { DVec3::Z };
        let right = ahead.cross(upwards).normalize();
        let up = right.cross(ahead);
        let bounds = places.into_iter().fold(None, |bounds: Option<[DVec3; 2]>, place| {
            let at = DVec3::new(place.dot(right), place.dot(up), place.dot(ahead));
            Some(bounds.map_or([at, at], |[low, high]| [low.min(at), high.max(at)]))
        });
        let [low, high] = bounds.unwrap_or([-DVec3::ONE, DVec3::ONE]);
        let middle = (low + high) * 0.5;
        let extent = (high - low).max(DVec3::splat(1e-9));
        let scale = (1.0 - 2.0 * margin) * (size[0] / extent.x).min(size[1] / extent.y);
        let centre = right * middle.x + up * middle.y + ahead * middle.z;
        Self { right, up, ahead, centre, scale, size }
    }

    /// Projects a position [m] to the image: distance from the left edge [px], distance from the upper edge [px], depth
    /// away from the viewer [m].
    pub fn project(&self, place: DVec3) -> [f64; 3] {
        let from = place - self.centre;
        [
            0.5 * self.size[0] + self.scale * from.dot(self.right),
            0.5 * self.size[1] - self.scale * from.dot(self.up),
            from.dot(self.ahead),
        ]
    }

    /// Returns true if a face with this outward normal is turned towards the viewer.
    pub fn faces(&self, normal: DVec3) -> bool {
        normal.dot(self.ahead) < 0.0
    }

    /// Brightness (0 to 1) of a face with this normal (any length). The light comes from behind the viewer, from the
    /// upper left.
    pub fn light(&self, normal: DVec3) -> f64 {
        let towards = (self.up * 0.75 - self.right * 0.45 - self.ahead * 0.8).normalize();
        0.5 + 0.5 * normal.normalize_or_zero().dot(towards).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_view_along_y_has_x_to_the_right_and_z_upwards() {
        let corners = [DVec3::new(1.0, 5.0, -1.0), DVec3::new(3.0, 9.0, 0.0)];
        let view = View::along(DVec3::Y, corners, [200.0, 200.0], 0.0);
        let [x, y, near] = view.project(corners[0]);
        // The width of 2 m fills 200 px. The height of 1 m is centred.
        assert!(x.abs() < 1e-9 && (y - 150.0).abs() < 1e-9, "{x} {y}");
        let [x, y, far] = view.project(corners[1]);
        assert!((x - 200.0).abs() < 1e-9 && (y - 50.0).abs() < 1e-9 && far > near);
        assert!(view.faces(-DVec3::Y) && !view.faces(DVec3::Y));
    }
}
