//! The buffer of a region beyond an interface with another region.

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::case::{Case, Region};
use crate::sph::pairs::rate::Rate;

/// Water beyond an end of a region, which takes its state from the neighbouring region.
#[derive(Debug, Clone)]
pub struct Buffer {
    /// x of the interface between the two regions [m].
    pub interface: f64,
    /// Direction along x out of the region: -1 at its seaward end, 1 at its shoreward end.
    pub outwards: f64,
    /// Number of the neighbouring region in the order of [`Domain::regions`](crate::case::Domain::regions).
    pub neighbour: usize,
    /// x of the outer edge, at which particles enter and leave the buffer [m].
    pub edge: f64,
    /// Places on the outer edge at which particles can enter.
    pub(in crate::simulation::flume) places: Vec<Place>,
    /// Identification number of each particle that was in the buffer at the start of the time step, with the rate that
    /// the neighbouring region gives to it; `None` where that region is dry. Sorted by number.
    pub(super) given: Vec<(u32, Option<Rate>)>,
    /// State of the buffer.
    pub state: BufferState,
}

/// A cell of the outer edge, one particle spacing wide and high.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation::flume) struct Place {
    /// y and z of its centre [m].
    pub at: DVec2,
    /// Flow of the neighbouring region through the cell at the start of the time step; `None` if the cell is dry.
    pub flow: Option<Flow>,
}

/// Flow through a cell of the outer edge.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation::flume) struct Flow {
    /// Share of the cell below the free surface [-].
    pub share: f64,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Density [kg/m3].
    pub density: f64,
}

/// State of a buffer; part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BufferState {
    /// For each place on the outer edge, the distance [m] by which water has moved into the buffer since its last
    /// particle passed the edge.
    pub advance: Vec<f64>,
    /// Mass that the region has received through the interface, minus mass that it has lost [kg].
    pub received: f64,
}

impl Buffer {
    /// Returns the buffers of a region. `regions` lists all regions; `case` is the case of this region.
    pub fn of_region(region: &Region, regions: &[Region], case: &Case) -> Vec<Self> {
        let ends = [(0, -1.0), (1, 1.0)].into_iter().filter(|(end, _)| region.continues[*end]);
        let buffer = |(end, outwards): (usize, f64)| {
            let interface = region.x[end];
            let is_neighbour = |other: &Region| other.x[1 - end] == interface;
            let neighbour = regions.iter().position(is_neighbour).expect("regions leave no gaps");
            let (edge, domain) = (case.domain.x[end], &case.domain);
            let across = (0..domain.ny).map(|j| (j as f64 + 0.5) * domain.dy);
            let rows = domain.wavemaker_rows(&case.flume, edge);
            let place = |y: f64| rows.iter().map(move |&z| Place { at: DVec2::new(y, z), flow: None });
            let places: Vec<Place> = across.flat_map(place).collect();
            let state = BufferState { advance: vec![0.0; places.len()], received: 0.0 };
            Self { interface, outwards, neighbour, edge, places, given: Vec::new(), state }
        };
        ends.map(buffer).collect()
    }

    /// Returns true if `x` [m] is beyond the interface. The interface itself belongs to its shoreward region.
    pub fn contains(&self, x: f64) -> bool {
        if self.outwards > 0.0 { x >= self.interface } else { x < self.interface }
    }

    /// Returns whether the particle `id` was in the buffer at the start of the time step, and its given rate.
    pub(super) fn given_to(&self, id: u32) -> Option<Option<Rate>> {
        let place = self.given.binary_search_by_key(&id, |(id, _)| *id).ok()?;
        Some(self.given[place].1)
    }
}
