#pragma once

namespace rung {

/// Advises the kernel to back the heap with huge pages; once a process, later
/// calls do nothing. Page faults were a quarter of the time of linting a large
/// program where this was measured, and nine tenths of starting Z3.
/// Only glibc on Linux; elsewhere, or without huge pages, nothing happens.
void prepare_heap();

}  // namespace rung
