use super::*;

const FLUID: [(&str, FieldKind); 3] =
    [("velocity", FieldKind::Vector), ("pressure", FieldKind::Scalar), ("kind", FieldKind::Integer)];

fn append_particles(series: &mut PolyDataSeries, step: usize, count: usize) {
    let points: Vec<[f32; 3]> = (0..count).map(|i| [i as f32, step as f32, 0.5]).collect();
    let pressure: Vec<f32> = (0..count).map(|i| (100 * step + i) as f32).collect();
    let kind = vec![step as i32; count];
    let values = [FieldValues::Vector(&points), FieldValues::Scalar(&pressure), FieldValues::Integer(&kind)];
    series.append(0.1 * step as f64, &points, &[], &values).unwrap();
}

fn list(file: &File, name: &str) -> Vec<i64> {
    file.dataset(&format!("VTKHDF/{name}")).unwrap().read_raw().unwrap()
}

#[test]
fn the_number_of_particles_may_change_from_step_to_step() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fluid.vtkhdf");
    let mut series = PolyDataSeries::create(&path, Cells::Vertices, &FLUID).unwrap();
    for (step, count) in [5, 3, 7, 0, 2].into_iter().enumerate() {
        append_particles(&mut series, step, count);
    }
    // The copy is made while the series is still open. It is therefore the same file as after a killed run.
    let left_behind = folder.path().join("killed.vtkhdf");
    std::fs::copy(&path, &left_behind).unwrap();
    let file = File::open(&left_behind).unwrap();
    assert_eq!(file.group("VTKHDF/Steps").unwrap().attr("NSteps").unwrap().read_scalar::<i64>().unwrap(), 5);
    assert_eq!(file.group("VTKHDF").unwrap().attr("Version").unwrap().read_raw::<i64>().unwrap(), [2, 0]);
    assert_eq!(list(&file, "NumberOfPoints"), [5, 3, 7, 0, 2]);
    assert_eq!(list(&file, "Vertices/NumberOfCells"), [5, 3, 7, 0, 2]);
    assert_eq!(list(&file, "Polygons/NumberOfCells"), [0; 5]);
    assert_eq!(list(&file, "Steps/PointOffsets"), [0, 5, 8, 15, 15]);
    assert_eq!(list(&file, "Steps/PointDataOffsets/pressure"), [0, 5, 8, 15, 15]);
    assert_eq!(list(&file, "Steps/CellOffsets"), [0; 20]);
    assert_eq!(list(&file, "Vertices/Offsets"), (0..=7).collect::<Vec<_>>());
    assert_eq!(list(&file, "Lines/Offsets"), [0]);
    assert_eq!(list(&file, "Vertices/Connectivity"), (0..7).collect::<Vec<_>>());
    let pressure: Vec<f32> = file.dataset("VTKHDF/PointData/pressure").unwrap().read_raw().unwrap();
    assert_eq!(pressure[5..8], [100.0, 101.0, 102.0]);
    assert_eq!(file.dataset("VTKHDF/PointData/velocity").unwrap().shape(), [17, 3]);
}

#[test]
fn a_resumed_series_continues_after_the_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fluid.vtkhdf");
    let mut series = PolyDataSeries::create(&path, Cells::Vertices, &FLUID).unwrap();
    for (step, count) in [5, 3, 7, 4].into_iter().enumerate() {
        append_particles(&mut series, step, count);
    }
    drop(series);
    let mut series = PolyDataSeries::reopen(&path, Cells::Vertices, &FLUID, 2).unwrap();
    assert_eq!(series.steps(), 2);
    append_particles(&mut series, 2, 6);
    drop(series);
    let file = File::open(&path).unwrap();
    assert_eq!(list(&file, "NumberOfPoints"), [5, 3, 6]);
    assert_eq!(list(&file, "Steps/PointOffsets"), [0, 5, 8]);
    assert_eq!(file.dataset("VTKHDF/Points").unwrap().shape(), [14, 3]);
    let pressure: Vec<f32> = file.dataset("VTKHDF/PointData/pressure").unwrap().read_raw().unwrap();
    assert_eq!(pressure[8..], [200.0, 201.0, 202.0, 203.0, 204.0, 205.0]);
    drop(file);
    let error = PolyDataSeries::reopen(&path, Cells::Vertices, &FLUID, 9).unwrap_err();
    assert!(error.to_string().contains("has 3 steps, fewer than the 9"), "{error}");
}

#[test]
fn triangles_are_written_again_only_when_they_change() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("units.vtkhdf");
    let fields = [("unit", FieldKind::Integer)];
    let whole = [[0, 1, 2], [0, 2, 3]];
    let step = |series: &mut PolyDataSeries, time: f64, triangles: &[[u32; 3]]| {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, time as f32], [0.0, 1.0, 0.0]];
        series.append(time, &points, triangles, &[FieldValues::Integer(&[1, 1, 1, 2])]).unwrap();
    };
    let mut series = PolyDataSeries::create(&path, Cells::Triangles, &fields).unwrap();
    step(&mut series, 0.0, &whole);
    step(&mut series, 0.1, &whole);
    step(&mut series, 0.2, &whole[1..]);
    step(&mut series, 0.3, &whole);
    drop(series);
    let mut series = PolyDataSeries::reopen(&path, Cells::Triangles, &fields, 3).unwrap();
    step(&mut series, 0.3, &whole[1..]);
    drop(series);
    let file = File::open(&path).unwrap();
    assert_eq!(list(&file, "Polygons/NumberOfCells"), [2, 2, 1, 1]);
    assert_eq!(list(&file, "Polygons/Connectivity"), [0, 1, 2, 0, 2, 3, 0, 2, 3]);
    assert_eq!(list(&file, "Polygons/Offsets"), [0, 3, 6]);
    let starts = list(&file, "Steps/ConnectivityIdOffsets");
    assert_eq!(starts.iter().skip(2).step_by(4).copied().collect::<Vec<_>>(), [0, 0, 6, 6]);
}

#[test]
fn points_at_rest_are_written_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("units.vtkhdf");
    let fields = [("unit", FieldKind::Integer)];
    let step = |series: &mut PolyDataSeries, time: f64, moved: f32| {
        let points = [[moved, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        series.append(time, &points, &[[0, 1, 2]], &[FieldValues::Integer(&[1; 3])]).unwrap();
    };
    let mut series = PolyDataSeries::create(&path, Cells::Triangles, &fields).unwrap().skipping_rest(0.1);
    step(&mut series, 0.0, 0.0);
    // A slow motion adds up: the limit holds for the distance from the last written position.
    step(&mut series, 0.1, 0.06);
    step(&mut series, 0.2, 0.12);
    step(&mut series, 0.3, 0.2);
    drop(series);
    // A resumed run goes on as a run without interruption.
    let mut series = PolyDataSeries::reopen(&path, Cells::Triangles, &fields, 3).unwrap().skipping_rest(0.1);
    step(&mut series, 0.3, 0.2);
    step(&mut series, 0.4, 0.3);
    drop(series);
    let file = File::open(&path).unwrap();
    assert_eq!(list(&file, "Steps/PointOffsets"), [0, 0, 3, 3, 6]);
    assert_eq!(list(&file, "Steps/PointDataOffsets/unit"), [0; 5]);
    assert_eq!(list(&file, "NumberOfPoints"), [3; 5]);
    assert_eq!(file.dataset("VTKHDF/Points").unwrap().shape(), [9, 3]);
    assert_eq!(file.dataset("VTKHDF/PointData/unit").unwrap().shape(), [3]);
}

#[test]
fn a_damaged_file_is_refused_on_resume() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("units.vtkhdf");
    let fields = [("unit", FieldKind::Integer)];
    type Damage = fn(&Dataset);
    let damages: [(&str, Damage); 5] = [
        ("NumberOfPoints", |dataset| dataset.resize(1).unwrap()),
        ("NumberOfPoints", |dataset| dataset.write_raw(&[3_i64, -3]).unwrap()),
        ("NumberOfPoints", |dataset| dataset.write_raw(&[3, i64::MAX]).unwrap()),
        ("Polygons/NumberOfConnectivityIds", |dataset| dataset.write_raw(&[3, i64::MAX]).unwrap()),
        ("Steps/Values", |dataset| dataset.resize(1).unwrap()),
    ];
    for (name, damage) in damages {
        let mut series = PolyDataSeries::create(&path, Cells::Triangles, &fields).unwrap();
        for time in [0.0, 0.1] {
            series.append(time, &[[0.0; 3]; 3], &[[0, 1, 2]], &[FieldValues::Integer(&[1; 3])]).unwrap();
        }
        drop(series);
        let file = layout::unlocked().open_rw(&path).unwrap();
        damage(&file.dataset(&format!("VTKHDF/{name}")).unwrap());
        drop(file);
        let error = PolyDataSeries::reopen(&path, Cells::Triangles, &fields, 2).err().unwrap().to_string();
        assert!(error.contains("units.vtkhdf: HDF5: the dataset /VTKHDF/") && error.contains("is damaged"), "{error}");
    }
}

#[test]
fn a_damaged_index_of_chunks_is_refused_on_resume() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("units.vtkhdf");
    let mut series = PolyDataSeries::create(&path, Cells::Triangles, &[]).unwrap();
    for step in 0..3 {
        series.append(f64::from(step), &[[step as f32; 3]; 30_000], &[[0, 1, 2]], &[]).unwrap();
    }
    drop(series);
    let whole = std::fs::read(&path).unwrap();
    // Signatures of the blocks of an index in the format of HDF5: header, index block, data block.
    for (signature, least) in [(b"EAHD", 10), (b"EAIB", 10), (b"EADB", 1)] {
        let blocks: Vec<usize> = (0..whole.len() - 4).filter(|at| whole[*at..*at + 4] == signature[..]).collect();
        let mut refused = 0;
        for block in &blocks {
            for at in [block + 5, block + 12, block + 20] {
                let mut damaged = whole.clone();
                damaged[at] ^= 0x41;
                std::fs::write(&path, &damaged).unwrap();
                // Blocks that the resume does not read may be damaged.
                let opened = PolyDataSeries::reopen(&path, Cells::Triangles, &[], 1);
                refused += usize::from(opened.is_err_and(|error| error.to_string().contains("units.vtkhdf: HDF5: ")));
            }
        }
        assert!(refused >= 3 * least, "{refused} of {} damages refused", 3 * blocks.len());
    }
}

#[test]
fn an_error_names_the_file() {
    let error = PolyDataSeries::create(Path::new("/nowhere/fluid.vtkhdf"), Cells::Vertices, &[]).unwrap_err();
    assert!(error.to_string().starts_with("/nowhere/fluid.vtkhdf: HDF5: "), "{error}");
}
