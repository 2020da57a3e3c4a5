// SPDX-License-Identifier: MIT
/// The list of shape functions: the one place that names them all.
#pragma once

#include <optional>
#include <string>
#include <vector>

/// X(enumerator, type in grid/kernels.hpp, words of command files separated by blanks, the first of them preferred)
#define TRIBO_SHAPE_FUNCTIONS(X)                               \
  X(linear, LinearKernel, "Classic Dirac linear 0")            \
  X(gimp, GimpKernel, "uGIMP GIMP 1")                          \
  X(cpdi, CpdiCornerKernel, "lCPDI CPDI 2")                    \
  X(quadratic_spline, QuadraticKernel, "B2SPLINE quadratic 6") \
  X(cubic_spline, CubicKernel, "B3SPLINE cubic")

namespace tribo {

#define TRIBO_ENUMERATOR(name, type, words) name,
enum class Kernel { TRIBO_SHAPE_FUNCTIONS(TRIBO_ENUMERATOR) };
#undef TRIBO_ENUMERATOR

/// The words of a shape function in command files, the preferred one first.
std::vector<std::string> words_of(Kernel kernel);
/// The shape function that a word means, capital letters or not; none if no shape function has this name.
std::optional<Kernel> kernel_of(const std::string& word);
/// The words of all shape functions, separated by blanks.
const std::string& all_kernel_words();

}  // namespace tribo
