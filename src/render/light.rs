//! The light, fixed in the world: a hemisphere and two directional lights.

/// A light infinitely far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// From the object towards the light, world frame; need not be a unit vector.
    pub towards_light_in_world: [f32; 3],
    /// Linear intensity: a white surface facing the light reflects this much of full white.
    pub intensity: f32,
}

/// Light settings. Lambert's law and no shadows, so a surface point has one colour
/// from wherever it is seen, as NeRF training wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Linear light from straight above.
    pub sky: f32,
    /// Linear light from straight below; between the two it is mixed by the normal's z.
    pub ground: f32,
    /// The main light.
    pub key: DirectionalLight,
    /// The weaker light from the other side.
    pub fill: DirectionalLight,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            sky: 0.42,
            ground: 0.24,
            key: DirectionalLight { towards_light_in_world: [0.45, -0.55, 0.7], intensity: 0.5 },
            fill: DirectionalLight { towards_light_in_world: [-0.75, 0.5, 0.3], intensity: 0.22 },
        }
    }
}

impl Light {
    /// The lights turned about the world's z axis by so many radians, anticlockwise from above.
    #[must_use]
    pub fn turned(&self, yaw_rad: f64) -> Light {
        let (sin, cos) = (yaw_rad.sin() as f32, yaw_rad.cos() as f32);
        let turned = |light: &DirectionalLight| {
            let [x, y, z] = light.towards_light_in_world;
            DirectionalLight { towards_light_in_world: [cos * x - sin * y, sin * x + cos * y, z], ..*light }
        };
        Light { key: turned(&self.key), fill: turned(&self.fill), ..*self }
    }
}

/// [`Light`] made ready for many evaluations.
#[derive(Clone, Copy)]
pub(super) struct PreparedLight {
    middle: f32,
    slope: f32,
    key: [f32; 3],
    fill: [f32; 3],
}

impl PreparedLight {
    pub(super) fn new(light: &Light) -> Self {
        let scaled = |l: &DirectionalLight| {
            let [x, y, z] = l.towards_light_in_world;
            let length = (x * x + y * y + z * z).sqrt();
            let scale = if length > 0.0 { l.intensity / length } else { 0.0 };
            [x * scale, y * scale, z * scale]
        };
        Self {
            middle: 0.5 * (light.sky + light.ground),
            slope: 0.5 * (light.sky - light.ground),
            key: scaled(&light.key),
            fill: scaled(&light.fill),
        }
    }

    /// Linear light on a surface with the given unit normal (world frame).
    #[inline]
    pub(super) fn at(&self, normal: [f32; 3]) -> f32 {
        let dot = |l: [f32; 3]| l[0] * normal[0] + l[1] * normal[1] + l[2] * normal[2];
        self.middle + self.slope * normal[2] + dot(self.key).max(0.0) + dot(self.fill).max(0.0)
    }
}
