// How many workgroups the lists of cells take, and the tasks that say so (task.wgsl).

@group(0) @binding(BIND_Found) var<storage, read> found: array<u32, 2>;
@group(0) @binding(BIND_Groups) var<storage, read_write> tasks: array<vec4<u32>, 4>;

@compute @workgroup_size(2)
fn groups(@builtin(local_invocation_index) list: u32) {
    let count = found[list];
    let of_list = (count + 63u) / 64u;
    let row = ROW / 64u;
    // The numbers of cells in which several solids meet stand for their rows of excess.
    tasks[2u * list] = vec4<u32>(min(of_list, row), (of_list + row - 1u) / row, 1u, 0u);
    tasks[2u * list + 1u] = vec4<u32>(count, 1u, 1u, count * list);
}
