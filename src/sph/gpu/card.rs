//! Graphics cards: detection, opening, buffers and reading of results.

use std::{
    fmt,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Mutex, PoisonError},
};

use bytemuck::Pod;
use wgpu::{Backends, BufferDescriptor, BufferUsages, DeviceDescriptor, DeviceType, Features, Instance, Limits};

use crate::sph::solver::backend::DeviceError;

/// Number of workgroups that every card supports in one dimension of a dispatch.
const MAX_GROUPS: u64 = 65_535;

/// The flag `VK_MEMORY_HEAP_DEVICE_LOCAL_BIT` of Vulkan, for memory regions of the card itself.
#[cfg(not(target_vendor = "apple"))]
const DEVICE_LOCAL: u32 = 1;

/// Properties of a card that are known before the card is opened.
#[derive(Debug, Clone, PartialEq)]
pub struct CardInfo {
    /// Name of the card.
    pub name: String,
    /// Graphics interface (Vulkan, Metal or Dx12) and driver.
    pub interface: String,
    /// True if the card is a software renderer, which runs on the processor.
    pub is_software: bool,
    /// Largest buffer that a shader can bind [bytes].
    pub largest_binding: u64,
    /// Largest buffer [bytes].
    pub largest_buffer: u64,
    /// Total memory [bytes], if the system reports it.
    pub memory: Option<u64>,
}

/// An open card.
#[derive(Clone)]
pub struct Card {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    info: Arc<CardInfo>,
    /// First failure since the card was opened.
    failure: Arc<Mutex<Option<Trouble>>>,
}

#[derive(Debug, Clone)]
enum Trouble {
    Memory(String),
    Lost(String),
}

impl fmt::Debug for Card {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_tuple("Card").field(&self.info).finish()
    }
}

fn adapters() -> Vec<wgpu::Adapter> {
    let instance = Instance::default();
    let mut adapters =
        pollster::block_on(instance.enumerate_adapters(Backends::VULKAN | Backends::METAL | Backends::DX12));
    // The order is: discrete cards, virtual cards, integrated cards, other cards, software renderers.
    adapters.sort_by_key(|adapter| match adapter.get_info().device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::VirtualGpu => 1,
        DeviceType::IntegratedGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    });
    adapters
}

fn describe(adapter: &wgpu::Adapter) -> CardInfo {
    let (info, limits) = (adapter.get_info(), adapter.limits());
    CardInfo {
        name: info.name,
        interface: format!("{:?}, {} {}", info.backend, info.driver, info.driver_info).trim().to_owned(),
        is_software: info.device_type == DeviceType::Cpu,
        largest_binding: limits.max_storage_buffer_binding_size,
        largest_buffer: limits.max_buffer_size,
        memory: memory_of(adapter),
    }
}

/// Returns the size of the largest memory region of the card that Vulkan reports [bytes]. Vulkan also reports regions
/// of host memory, which do not count.
fn memory_of(adapter: &wgpu::Adapter) -> Option<u64> {
    #[cfg(not(target_vendor = "apple"))]
    // SAFETY: the handles are used only to query the heap sizes, while the adapter is alive.
    return unsafe {
        let vulkan = adapter.as_hal::<wgpu::hal::api::Vulkan>()?;
        let instance = vulkan.shared_instance().raw_instance();
        let memory = instance.get_physical_device_memory_properties(vulkan.raw_physical_device());
        let heaps = memory.memory_heaps.iter().take(memory.memory_heap_count as usize);
        heaps.filter(|heap| heap.flags.as_raw() & DEVICE_LOCAL != 0).map(|heap| heap.size).max()
    };
    #[cfg(target_vendor = "apple")]
    None
}

impl Card {
    /// Returns all cards, software renderers last. The index of a card is the number N in `--device gpu:N`.
    pub fn all() -> Vec<CardInfo> {
        adapters().iter().map(describe).collect()
    }

    /// Opens the card with this number, see [`Self::all`].
    ///
    /// # Errors
    /// If there is no such card, or if it cannot be opened.
    pub fn open(number: usize) -> Result<Self, DeviceError> {
        let adapters = adapters();
        let adapter = adapters.get(number).ok_or_else(|| {
            let count = match adapters.len() {
                0 => "there is no graphics card and no software renderer".to_owned(),
                1 => "there is one device, gpu:0".to_owned(),
                n => format!("there are {n} devices, gpu:0 to gpu:{}", n - 1),
            };
            DeviceError::Missing(format!("--device gpu:{number}: {count}; run breakwater devices for a list"))
        })?;
        let info = describe(adapter);
        let supported = adapter.limits();
        let limits = Limits {
            max_storage_buffer_binding_size: supported.max_storage_buffer_binding_size,
            max_buffer_size: supported.max_buffer_size,
            ..Limits::default()
        };
        let descriptor = DeviceDescriptor {
            label: Some("breakwater"),
            required_features: Features::empty(),
            required_limits: limits,
            ..DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| DeviceError::Missing(format!("cannot open {}: {error}", info.name)))?;
        let failure = Arc::new(Mutex::new(None));
        let recorder = |failure: &Arc<Mutex<Option<Trouble>>>| {
            let failure = failure.clone();
            move |what: Trouble| {
                failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(what);
            }
        };
        let on_error = recorder(&failure);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            on_error(match error {
                wgpu::Error::OutOfMemory { .. } => Trouble::Memory("an allocation failed".to_owned()),
                error => Trouble::Lost(error.to_string()),
            });
        }));
        let on_loss = recorder(&failure);
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                on_loss(Trouble::Lost(message));
            }
        });
        Ok(Self { device, queue, info: Arc::new(info), failure })
    }

    /// Returns the name of the card.
    pub fn name(&self) -> &str {
        &self.info.name
    }

    /// Returns the properties of the card.
    pub fn info(&self) -> &CardInfo {
        &self.info
    }

    /// Checks that the card has not failed since it was opened.
    ///
    /// # Errors
    /// The first failure of the card.
    pub(super) fn check(&self) -> Result<(), DeviceError> {
        let device = self.info.name.clone();
        match self.failure.lock().unwrap_or_else(PoisonError::into_inner).clone() {
            None => Ok(()),
            Some(Trouble::Memory(what)) => Err(DeviceError::Memory { device, what }),
            Some(Trouble::Lost(what)) => Err(DeviceError::Lost { device, what }),
        }
    }

    /// Creates a buffer of `count` values that shaders and host can read and write.
    ///
    /// # Errors
    /// If the card does not support a buffer of this size or has too little memory left.
    pub(super) fn buffer<T: Pod>(&self, label: &'static str, count: usize) -> Result<wgpu::Buffer, DeviceError> {
        let size = (count.max(1) * size_of::<T>()) as u64;
        let most = self.info.largest_binding.min(self.info.largest_buffer);
        if size > most {
            let what = format!(
                "a buffer ({label}) needs {:.2} GB, and the card allows at most {:.2} GB per buffer",
                size as f64 / 1e9,
                most as f64 / 1e9
            );
            return Err(DeviceError::Memory { device: self.info.name.clone(), what });
        }
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
        let buffer =
            self.device.create_buffer(&BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false });
        self.check()?;
        Ok(buffer)
    }

    /// Creates a buffer filled with `values`.
    ///
    /// # Errors
    /// The same errors as [`Self::buffer`].
    pub(crate) fn filled<T: Pod>(&self, label: &'static str, values: &[T]) -> Result<wgpu::Buffer, DeviceError> {
        let buffer = self.buffer::<T>(label, values.len())?;
        self.write(&buffer, 0, values);
        Ok(buffer)
    }

    /// Creates a uniform buffer with the content `value`.
    pub(super) fn uniform<T: Pod>(&self, label: &'static str, value: &T) -> wgpu::Buffer {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let size = size_of::<T>() as u64;
        let buffer =
            self.device.create_buffer(&BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false });
        self.queue.write_buffer(&buffer, 0, bytemuck::bytes_of(value));
        buffer
    }

    /// Writes `values` to a buffer from index `first` on. The card writes them before it executes commands that are
    /// submitted later.
    pub(super) fn write<T: Pod>(&self, buffer: &wgpu::Buffer, first: usize, values: &[T]) {
        if !values.is_empty() {
            self.queue.write_buffer(buffer, (first * size_of::<T>()) as u64, bytemuck::cast_slice(values));
        }
    }

    /// Executes the commands in `encoder`, then reads `count` values of a buffer from index `first` on.
    ///
    /// # Errors
    /// If the device is lost.
    pub(super) fn read<T: Pod>(
        &self,
        mut encoder: wgpu::CommandEncoder,
        buffer: &wgpu::Buffer,
        first: usize,
        count: usize,
    ) -> Result<Vec<T>, DeviceError> {
        let size = (count * size_of::<T>()) as u64;
        if count == 0 {
            self.queue.submit([encoder.finish()]);
            self.check()?;
            return Ok(Vec::new());
        }
        let usage = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let copy = self.device.create_buffer(&BufferDescriptor {
            label: Some("copy"),
            size,
            usage,
            mapped_at_creation: false,
        });
        encoder.copy_buffer_to_buffer(buffer, (first * size_of::<T>()) as u64, &copy, 0, size);
        self.queue.submit([encoder.finish()]);
        copy.map_async(wgpu::MapMode::Read, .., |_| ());
        self.wait()?;
        let view = copy.get_mapped_range(..).map_err(|error| self.lost(error))?;
        let values = bytemuck::pod_collect_to_vec(&view);
        drop(view);
        copy.unmap();
        Ok(values)
    }

    /// Creates an empty command list.
    pub(crate) fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("step") })
    }

    /// Submits commands to the card.
    pub(crate) fn submit(&self, encoder: wgpu::CommandEncoder) {
        self.queue.submit([encoder.finish()]);
    }

    /// Waits until all submitted commands are finished.
    ///
    /// # Errors
    /// If the device is lost.
    pub(crate) fn wait(&self) -> Result<(), DeviceError> {
        self.check()?;
        // `poll` panics if the device is lost while it waits.
        let wait = AssertUnwindSafe(|| self.device.poll(wgpu::PollType::wait_indefinitely()));
        let waited = catch_unwind(wait).map_err(|_| self.lost("the device was lost during a wait"))?;
        waited.map_err(|error| self.lost(error))?;
        self.check()
    }

    fn lost(&self, what: impl fmt::Display) -> DeviceError {
        DeviceError::Lost { device: self.info.name.clone(), what: what.to_string() }
    }
}

/// Returns the numbers of workgroups along x and y for at least `threads` threads, with `size` threads per workgroup.
/// The number along y exceeds 1 only if one dimension allows too few workgroups.
pub(crate) fn groups(threads: usize, size: usize) -> [u32; 2] {
    let all = (threads.div_ceil(size) as u64).max(1);
    let rows = all.div_ceil(MAX_GROUPS);
    [all.div_ceil(rows) as u32, rows as u32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_large_buffers_are_refused_with_advice() {
        let Ok(card) = Card::open(0) else { return println!("skipped: no card") };
        let count = (card.info.largest_binding / 16 + 1) as usize;
        let message = card.buffer::<[f32; 4]>("the test", count).unwrap_err().to_string();
        for part in [card.name(), "a buffer (the test) needs", "raise domain.dp_m"] {
            assert!(message.contains(part), "{message}");
        }
    }

    #[test]
    fn missing_cards_are_refused() {
        let message = Card::open(99).unwrap_err().to_string();
        assert!(message.contains("--device gpu:99: there") && message.contains("breakwater devices"), "{message}");
    }

    #[test]
    fn dispatches_cover_all_threads_within_the_limit() {
        for threads in [0, 1, 64, 65, 64 * 65_535, 64 * 65_535 + 1, 2_000_000_000] {
            let [x, y] = groups(threads, 64);
            assert!(u64::from(x) <= MAX_GROUPS && u64::from(y) <= MAX_GROUPS);
            let all = u64::from(x) * u64::from(y) * 64;
            assert!(all >= threads as u64 && all < threads as u64 + 64 * (u64::from(y) + 1));
        }
    }
}
