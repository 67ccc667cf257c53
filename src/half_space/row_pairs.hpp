#pragma once

/// @file
/// Two rows of real numbers as the real and the imaginary part of one row of complex numbers: one
/// transform gives the half spectra of both.

#include <cstddef>

namespace mems_stiction {
namespace row_pairs {

/// complex[i] = first[i] + i second[i].
void join(std::size_t count, const float* first, const float* second, float* complex);
void join(std::size_t count, const double* first, const double* second, double* complex);
void split(std::size_t count, const float* complex, float* first, float* second);
void split(std::size_t count, const double* complex, double* first, double* second);

/// Twice the half spectra, count/2 + 1 complex numbers each, of both rows from the spectrum of the
/// joined rows.
void splitSpectrum(std::size_t count, const float* joined, float* first, float* second);
void splitSpectrum(std::size_t count, const double* joined, double* first, double* second);
/// The spectrum of the joined rows from their half spectra.
void joinSpectra(std::size_t count, const float* first, const float* second, float* joined);
void joinSpectra(std::size_t count, const double* first, const double* second, double* joined);

}  // namespace row_pairs
}  // namespace mems_stiction
