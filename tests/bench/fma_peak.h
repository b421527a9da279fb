#pragma once

namespace bench {

/// Processor time of this thread, s: what other jobs take of the core is not in it.
[[nodiscard]] double processor_s();

/// Floating-point operations per second of one core: multiply-adds on registers alone, enough of
/// them at once to hide their latency, in the longest vectors there are. Takes about 1 ms.
template <typename T>
[[nodiscard]] double fma_peak();
template <>
[[nodiscard]] double fma_peak<float>();
template <>
[[nodiscard]] double fma_peak<double>();

/// It ran on, as do the solver's kernels.
[[nodiscard]] const char* instruction_set();

}  // namespace bench
