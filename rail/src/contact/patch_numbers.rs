//! The numbers of a contact patch that the step reads.

/// A loaded patch as its source gives it: scalars, vector lanes, or numbers with derivatives.
#[derive(Debug, Clone, Copy)]
pub struct PatchNumbers<T> {
    /// Elastic normal load, N.
    pub load: T,
    /// Load of the whole patch that it is a part of, N.
    pub whole_load: T,
    /// Sine of the contact angle in the rail's axes.
    pub sine: T,
    /// Lateral position on the wheel, m.
    pub wheel_y: T,
    /// Depth on the wheel, m.
    pub wheel_z: T,
    /// Semi-axes of the whole patch in the rolling direction and across, m.
    pub semi_axes: [T; 2],
    /// Peak pressure, Pa.
    pub peak_pressure: T,
}

impl<T> PatchNumbers<T> {
    /// Unpacks the numbers.
    #[inline(always)]
    pub fn from_array(packed: [T; 8]) -> Self {
        let [
            load,
            whole_load,
            sine,
            wheel_y,
            wheel_z,
            a,
            b,
            peak_pressure,
        ] = packed;
        Self {
            load,
            whole_load,
            sine,
            wheel_y,
            wheel_z,
            semi_axes: [a, b],
            peak_pressure,
        }
    }

    /// The numbers as an array.
    #[inline(always)]
    pub fn into_array(self) -> [T; 8] {
        let [a, b] = self.semi_axes;
        [
            self.load,
            self.whole_load,
            self.sine,
            self.wheel_y,
            self.wheel_z,
            a,
            b,
            self.peak_pressure,
        ]
    }
}
