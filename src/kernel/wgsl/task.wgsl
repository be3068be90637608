// Which cells are to be worked on.

struct Task {
    // How many.
    count: u32,
    // 0: all cells in their order, 1: those of the list.
    is_listed: u32,
    // 0: the populations are kept as they are before a collision (at the start of a run), 1: as they
    // are after it.
    is_collided: u32,
    // Records of cells in which several solids meet; they come first.
    many: u32,
}

@group(0) @binding(BIND_Task) var<uniform> task: Task;
@group(0) @binding(BIND_CellList) var<storage, read> cell_list: array<u32>;

fn listed(number: u32) -> u32 {
    if (task.is_listed == 1u) {
        return cell_list[number];
    }
    return number;
}

// The populations of a cell before their next collision.
fn observed(at: vec3<u32>) -> array<f32, 19> {
//#if BEFORE
    return own(at.x, at.y, at.z);
//#else
//#if AFTER
    return entering(at.x, at.y, at.z);
//#else
    if (task.is_collided == 1u) {
        return entering(at.x, at.y, at.z);
    }
    return own(at.x, at.y, at.z);
//#end
//#end
}
