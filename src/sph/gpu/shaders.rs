//! The shaders (programs for the card). Each source file is in the folder of the Rust file with the same equations. The
//! macro `shader!` puts the code that several shaders use before the code of each shader.

use super::card::Card;

/// Concatenates the source files of a shader.
macro_rules! shader {
    ($($file:literal),+) => { concat!($(include_str!($file), "\n"),+) };
}

/// Shader of the counting sort.
pub const GRID: &str = shader!("../parameters.wgsl", "../neighbours/grid.wgsl");
/// Shader that creates the particle records.
pub const RECORDS: &str = shader!("../parameters.wgsl", "../neighbours/records.wgsl");
/// Shader of the boundary densities (mDBC).
pub const MDBC: &str =
    shader!("../parameters.wgsl", "../terms/kernel.wgsl", "../neighbours/lists.wgsl", "../boundary/mdbc.wgsl");
/// Shader of the rates (equations 1 and 2).
pub const RATES: &str =
    shader!("../parameters.wgsl", "../terms/kernel.wgsl", "../neighbours/lists.wgsl", "../pairs/rates.wgsl");
/// Shader of predictor and corrector.
pub const STEP: &str = shader!("../parameters.wgsl", "../solver/step.wgsl");
/// Shader that finds the water near surfaces, and writes changed velocities of this water back.
pub const NEAR: &str = shader!("../parameters.wgsl", "near.wgsl");

/// A compiled function of a shader; in this folder, "kernel" does not mean the SPH kernel.
#[derive(Debug)]
pub struct Kernel {
    pipeline: wgpu::ComputePipeline,
    name: &'static str,
}

/// A compiled function of a shader with its buffers.
#[derive(Debug)]
pub struct Bound {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

/// A shader, ready for compilation on a card.
pub struct Shader<'a> {
    card: &'a Card,
    module: wgpu::ShaderModule,
    constants: &'static [(&'static str, f64)],
}

impl<'a> Shader<'a> {
    /// Creates a shader from a source, for example [`GRID`].
    pub fn new(card: &'a Card, source: &'static str) -> Self {
        let descriptor = wgpu::ShaderModuleDescriptor { label: None, source: wgpu::ShaderSource::Wgsl(source.into()) };
        // SAFETY: all shaders are part of this crate. In these shaders, threads beyond the last particle use no
        // data, indices stay within their arrays, bins are limited to the grid, and every loop ends.
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

    /// Sets the shader constant `PERIODIC`: true if the flume is periodic across its width.
    pub fn periodic(self, is_periodic: bool) -> Self {
        Self { constants: if is_periodic { &[("PERIODIC", 1.0)] } else { &[] }, ..self }
    }

    /// Compiles the function `name` of the shader.
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
    /// Binds buffers to the function, each by its binding number.
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
    /// Adds a command to `encoder` that runs the function with x times y workgroups.
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
        ("near", NEAR),
        ("peaks", crate::bench::card::PEAKS),
    ];

    #[test]
    fn shaders_are_valid_and_stay_within_the_binding_limit_of_every_card() {
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
                assert!(storage.count() <= 8, "{name}: {} binds more than 8 storage buffers", entry.name);
            }
        }
    }

    #[test]
    fn constants_have_the_size_of_the_shader_structs() {
        use super::super::constants::{Constants, StepConstants};
        use super::super::near::{NearParticle, SurfaceConstants};
        use super::super::sort::SortConstants;
        let size_of_struct = |source: &str, name: &str| {
            let module = wgsl::parse_str(source).unwrap();
            let named = module.types.iter().find(|(_, of_type)| of_type.name.as_deref() == Some(name));
            match named.map(|(_, of_type)| of_type.inner.clone()) {
                Some(naga::TypeInner::Struct { span, .. }) => span as usize,
                _ => panic!("{name} is not a struct"),
            }
        };
        assert_eq!(size_of_struct(RATES, "Parameters"), size_of::<Constants>());
        assert_eq!(size_of_struct(RATES, "Step"), size_of::<StepConstants>());
        assert_eq!(size_of_struct(NEAR, "Near"), size_of::<NearParticle>());
        // The Rust structs end with padding that the shaders do not declare. Therefore round sizes up to 16 bytes.
        assert_eq!(size_of_struct(GRID, "Sort").next_multiple_of(16), size_of::<SortConstants>());
        assert_eq!(size_of_struct(NEAR, "Surfaces").next_multiple_of(16), size_of::<SurfaceConstants>());
    }
}
