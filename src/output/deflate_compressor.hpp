// SPDX-License-Identifier: MIT
/// The zlib format of VTK files, made by libdeflate, which compresses twice as fast as zlib.
#pragma once

#include <libdeflate.h>
#include <vtkObjectFactory.h>
#include <vtkZLibDataCompressor.h>

#include <memory>

namespace tribo {

/// Compresses with level 1. Higher levels take several times as long, and the last digits of computed numbers are
/// random to all of them. Files name the compressor of VTK, whose format this is: the class has no name of its own.
class DeflateCompressor : public vtkZLibDataCompressor {
 public:
  static DeflateCompressor* New() { VTK_STANDARD_NEW_BODY(DeflateCompressor); }
  size_t GetMaximumCompressionSpace(size_t size) override {
    return libdeflate_zlib_compress_bound(compressor_.get(), size);
  }

 protected:
  size_t CompressBuffer(const unsigned char* data, size_t size, unsigned char* to, size_t space) override {
    return libdeflate_zlib_compress(compressor_.get(), data, size, to, space);
  }

 private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_{libdeflate_alloc_compressor(1)};
};

}  // namespace tribo
