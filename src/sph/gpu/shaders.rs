//! The shaders. Each lies beside the Rust file of its stage; what they have in common is put before it.

use super::card::Card;

/// A shader with all that it needs.
macro_rules! shader {
    ($($file:literal),+) => { concat!($(include_str!($file), "\n"),+) };
}

/// The counting sort.
pub const GRID: &str = shader!("../parameters.wgsl", "../grid.wgsl");
/// Records of the particles.
pub const RECORDS: &str = shader!("../parameters.wgsl", "../records.wgsl");
/// Densities of the boundary.
pub const MDBC: &str = shader!("../parameters.wgsl", "../kernel.wgsl", "../neighbours.wgsl", "../mdbc.wgsl");
/// Rates.
pub const RATES: &str = shader!("../parameters.wgsl", "../kernel.wgsl", "../neighbours.wgsl", "../rates.wgsl");
/// Predictor and corrector.
pub const STEP: &str = shader!("../parameters.wgsl", "../step.wgsl");
/// Water near to surfaces.
pub const IMPERMEABLE: &str = shader!("../parameters.wgsl", "../impermeable.wgsl");

/// A function of a shader, ready to run.
#[derive(Debug)]
pub struct Kernel {
    pipeline: wgpu::ComputePipeline,
    name: &'static str,
}

/// The same with the memory that it works on.
#[derive(Debug)]
pub struct Bound {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

/// A shader of a card.
pub struct Shader<'a> {
    card: &'a Card,
    module: wgpu::ShaderModule,
    constants: &'static [(&'static str, f64)],
}

impl<'a> Shader<'a> {
    /// Compile one of the shaders above.
    pub fn new(card: &'a Card, source: &'static str) -> Self {
        let descriptor = wgpu::ShaderModuleDescriptor { label: None, source: wgpu::ShaderSource::Wgsl(source.into()) };
        // SAFETY: the shaders are our own: threads beyond the particles return, indices are places in arrays of that length
        // or bins clamped to the grid, and every loop ends.
        let module = unsafe {
            let checks = if cfg!(debug_assertions) {
                wgpu::ShaderRuntimeChecks::checked()
            } else {
                wgpu::ShaderRuntimeChecks::unchecked()
            };
            card.device.create_shader_module_trusted(descriptor, checks)
        };
        Self { card, module, constants: &[] }
    }

    /// The same for a flume where what leaves on one side enters on the other, or not.
    pub fn periodic(self, is_periodic: bool) -> Self {
        Self { constants: if is_periodic { &[("PERIODIC", 1.0)] } else { &[] }, ..self }
    }

    /// One of its functions.
    pub fn kernel(&self, name: &'static str) -> Kernel {
        let pipeline = self.card.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: None,
            module: &self.module,
            entry_point: Some(name),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: self.constants,
                ..wgpu::PipelineCompilationOptions::default()
            },
            cache: None,
        });
        Kernel { pipeline, name }
    }
}

impl Kernel {
    /// The function on memory, by the numbers of the bindings.
    pub fn bind(&self, card: &Card, buffers: &[(u32, &wgpu::Buffer)]) -> Bound {
        let entries: Vec<wgpu::BindGroupEntry> = buffers
            .iter()
            .map(|&(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = card.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.name),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Bound { pipeline: self.pipeline.clone(), group }
    }
}

impl Bound {
    /// Run it over groups of threads.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, [x, y]: [u32; 2]) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(x, y, 1);
    }
}

#[cfg(test)]
mod tests {
    use naga::{
        AddressSpace,
        front::wgsl,
        valid::{Capabilities, ValidationFlags, Validator},
    };

    use super::*;

    const ALL: [(&str, &str); 7] = [
        ("grid", GRID),
        ("records", RECORDS),
        ("mdbc", MDBC),
        ("rates", RATES),
        ("step", STEP),
        ("impermeable", IMPERMEABLE),
        ("peaks", crate::bench::card::PEAKS),
    ];

    #[test]
    fn shaders_are_sound_and_bind_no_more_than_every_card_has() {
        for (name, source) in ALL {
            let module =
                wgsl::parse_str(source).unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
            let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
                .validate(&module)
                .unwrap_or_else(|error| panic!("{name}: {error:?}"));
            for (number, entry) in module.entry_points.iter().enumerate() {
                let of_entry = info.get_entry_point(number);
                let storage = module.global_variables.iter().filter(|(handle, variable)| {
                    matches!(variable.space, AddressSpace::Storage { .. }) && !of_entry[*handle].is_empty()
                });
                assert!(storage.count() <= 8, "{name}: {} binds too much", entry.name);
            }
        }
    }

    #[test]
    fn constants_have_the_size_that_the_shaders_expect() {
        use super::super::{
            constants::{Constants, StepConstants},
            near::{NearParticle, SurfaceConstants},
            sort::SortConstants,
        };
        let size_of_struct = |source: &str, name: &str| {
            let module = wgsl::parse_str(source).unwrap();
            let named = module.types.iter().find(|(_, of_type)| of_type.name.as_deref() == Some(name));
            match named.map(|(_, of_type)| of_type.inner.clone()) {
                Some(naga::TypeInner::Struct { span, .. }) => span as usize,
                _ => panic!("{name} is no struct"),
            }
        };
        assert_eq!(size_of_struct(RATES, "Parameters"), size_of::<Constants>());
        assert_eq!(size_of_struct(RATES, "Step"), size_of::<StepConstants>());
        assert_eq!(size_of_struct(IMPERMEABLE, "Near"), size_of::<NearParticle>());
        // Of whole vectors; the shaders need not name what fills the last one.
        assert_eq!(size_of_struct(GRID, "Sort").next_multiple_of(16), size_of::<SortConstants>());
        assert_eq!(size_of_struct(IMPERMEABLE, "Surfaces").next_multiple_of(16), size_of::<SurfaceConstants>());
    }
}
