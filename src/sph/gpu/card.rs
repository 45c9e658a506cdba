//! Graphics cards: finding, opening, buffers, reading back.

use std::{
    fmt,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Mutex, PoisonError},
};

use bytemuck::Pod;
use wgpu::{Backends, BufferDescriptor, BufferUsages, DeviceDescriptor, DeviceType, Features, Instance, Limits};

use crate::sph::backend::DeviceError;

/// Largest number of groups of a dispatch in one dimension, on every card.
const MOST_GROUPS: u64 = 65_535;

/// `VK_MEMORY_HEAP_DEVICE_LOCAL_BIT`.
#[cfg(not(target_vendor = "apple"))]
const DEVICE_LOCAL: u32 = 1;

/// What is known of a card without opening it.
#[derive(Debug, Clone, PartialEq)]
pub struct CardInfo {
    /// Its name.
    pub name: String,
    /// Vulkan, Metal or Dx12, and the driver.
    pub interface: String,
    /// Whether it is a program on the processor and no card.
    pub is_software: bool,
    /// Largest piece of memory that a shader can see [bytes].
    pub largest_binding: u64,
    /// Largest piece of memory [bytes].
    pub largest_buffer: u64,
    /// All of its memory [bytes], where the system tells it.
    pub memory: Option<u64>,
}

/// An open card.
#[derive(Clone)]
pub struct Card {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    info: Arc<CardInfo>,
    /// What went wrong since it was opened, if anything.
    trouble: Arc<Mutex<Option<Trouble>>>,
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
    // Cards of their own before those in the processor, programs that stand for one last.
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

/// Memory of a card that Vulkan shows: its largest heap of its own [bytes]. Cards also show that of the host.
fn memory_of(adapter: &wgpu::Adapter) -> Option<u64> {
    #[cfg(not(target_vendor = "apple"))]
    // SAFETY: the handles are only asked for the sizes of the heaps, while the adapter is alive.
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
    /// All cards that the system shows, those of hardware first; their numbers are their places here.
    pub fn all() -> Vec<CardInfo> {
        adapters().iter().map(describe).collect()
    }

    /// Open a card by its number.
    ///
    /// # Errors
    /// If there is no such card, or it does not open.
    pub fn open(number: usize) -> Result<Self, DeviceError> {
        let adapters = adapters();
        let adapter = adapters.get(number).ok_or_else(|| {
            let count = match adapters.len() {
                0 => "there is no graphics card here, and no driver that stands for one".to_owned(),
                1 => "there is one device, gpu:0".to_owned(),
                n => format!("there are {n} devices, gpu:0 to gpu:{}", n - 1),
            };
            DeviceError::Missing(format!("--device gpu:{number}: {count}; breakwater devices shows them"))
        })?;
        let info = describe(adapter);
        let has = adapter.limits();
        let limits = Limits {
            max_storage_buffer_binding_size: has.max_storage_buffer_binding_size,
            max_buffer_size: has.max_buffer_size,
            ..Limits::default()
        };
        let descriptor = DeviceDescriptor {
            label: Some("breakwater"),
            required_features: Features::empty(),
            required_limits: limits,
            ..DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| DeviceError::Missing(format!("{}: {error}", info.name)))?;
        let trouble = Arc::new(Mutex::new(None));
        let note = |trouble: &Arc<Mutex<Option<Trouble>>>| {
            let trouble = trouble.clone();
            move |what: Trouble| {
                trouble.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(what);
            }
        };
        let on_error = note(&trouble);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            on_error(match error {
                wgpu::Error::OutOfMemory { .. } => Trouble::Memory("an allocation failed".to_owned()),
                error => Trouble::Lost(error.to_string()),
            });
        }));
        let on_loss = note(&trouble);
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                on_loss(Trouble::Lost(message));
            }
        });
        Ok(Self { device, queue, info: Arc::new(info), trouble })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.info.name
    }

    /// What is known of it.
    pub fn info(&self) -> &CardInfo {
        &self.info
    }

    /// What has gone wrong since it was opened.
    ///
    /// # Errors
    /// If anything has.
    pub(super) fn check(&self) -> Result<(), DeviceError> {
        let device = self.info.name.clone();
        match self.trouble.lock().unwrap_or_else(PoisonError::into_inner).clone() {
            None => Ok(()),
            Some(Trouble::Memory(what)) => Err(DeviceError::Memory { device, what }),
            Some(Trouble::Lost(what)) => Err(DeviceError::Lost { device, what }),
        }
    }

    /// Memory for `count` values that shaders read and write, which the host fills and reads back.
    ///
    /// # Errors
    /// If the card cannot have such a piece of memory.
    pub(super) fn buffer<T: Pod>(&self, label: &'static str, count: usize) -> Result<wgpu::Buffer, DeviceError> {
        let size = (count.max(1) * size_of::<T>()) as u64;
        let most = self.info.largest_binding.min(self.info.largest_buffer);
        if size > most {
            let what = format!(
                "{label} needs a piece of {:.2} GB, and it gives at most {:.2} GB",
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

    /// Memory for the same with its values.
    ///
    /// # Errors
    /// As [`Self::buffer`].
    pub(crate) fn filled<T: Pod>(&self, label: &'static str, values: &[T]) -> Result<wgpu::Buffer, DeviceError> {
        let buffer = self.buffer::<T>(label, values.len())?;
        self.write(&buffer, 0, values);
        Ok(buffer)
    }

    /// Memory for constants.
    pub(super) fn uniform<T: Pod>(&self, label: &'static str, value: &T) -> wgpu::Buffer {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let size = size_of::<T>() as u64;
        let buffer =
            self.device.create_buffer(&BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false });
        self.queue.write_buffer(&buffer, 0, bytemuck::bytes_of(value));
        buffer
    }

    /// Write values from the place `first` on, before anything that is submitted later.
    pub(super) fn write<T: Pod>(&self, buffer: &wgpu::Buffer, first: usize, values: &[T]) {
        if !values.is_empty() {
            self.queue.write_buffer(buffer, (first * size_of::<T>()) as u64, bytemuck::cast_slice(values));
        }
    }

    /// Do what `encoder` holds, and read `count` values from the place `first` of a buffer on afterwards.
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

    /// A place for commands.
    pub(crate) fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("step") })
    }

    /// Give commands to the card.
    pub(crate) fn submit(&self, encoder: wgpu::CommandEncoder) {
        self.queue.submit([encoder.finish()]);
    }

    /// Wait until everything that was submitted is done.
    ///
    /// # Errors
    /// If the device is lost.
    pub(crate) fn wait(&self) -> Result<(), DeviceError> {
        self.check()?;
        // wgpu panics where it finds a device lost while it waits.
        let wait = AssertUnwindSafe(|| self.device.poll(wgpu::PollType::wait_indefinitely()));
        let waited = catch_unwind(wait).map_err(|_| self.lost("while waiting for it"))?;
        waited.map_err(|error| self.lost(error))?;
        self.check()
    }

    fn lost(&self, what: impl fmt::Display) -> DeviceError {
        DeviceError::Lost { device: self.info.name.clone(), what: what.to_string() }
    }
}

/// Groups of a dispatch over `threads` in groups of `size`, in two dimensions where one is too short.
pub(crate) fn groups(threads: usize, size: usize) -> [u32; 2] {
    let all = (threads.div_ceil(size) as u64).max(1);
    let rows = all.div_ceil(MOST_GROUPS);
    [all.div_ceil(rows) as u32, rows as u32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_much_memory_is_refused_with_the_way_out() {
        let Ok(card) = Card::open(0) else { return println!("skipped: no card") };
        let numbers = (card.info.largest_binding / 16 + 1) as usize;
        let message = card.buffer::<[f32; 4]>("the test", numbers).unwrap_err().to_string();
        for part in [card.name(), "the test needs a piece of", "raise domain.dp_m"] {
            assert!(message.contains(part), "{message}");
        }
    }

    #[test]
    fn a_card_that_is_not_there_is_refused() {
        let message = Card::open(99).unwrap_err().to_string();
        assert!(message.contains("--device gpu:99: there") && message.contains("breakwater devices"), "{message}");
    }

    #[test]
    fn dispatches_hold_all_threads_within_the_limit() {
        for threads in [0, 1, 64, 65, 64 * 65_535, 64 * 65_535 + 1, 2_000_000_000] {
            let [x, y] = groups(threads, 64);
            assert!(u64::from(x) <= MOST_GROUPS && u64::from(y) <= MOST_GROUPS);
            let all = u64::from(x) * u64::from(y) * 64;
            assert!(all >= threads as u64 && all < threads as u64 + 64 * (u64::from(y) + 1));
        }
    }
}
