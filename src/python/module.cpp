/// mems_stiction._core: the core for Python. Inputs are checked and explained in
/// python/mems_stiction, which is what users import; here they are only converted.

#include "bindings.hpp"
#include "memory.hpp"
#include "threads_inside.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace mems_stiction::python;
  module.doc() = "The C++ core. Import mems_stiction instead.";
  spareStaticObjects();
  bindErrors(module);
  bindMemory(module);
  bindSettings(module);
  bindScans(module);
  bindPrediction(module);
  bindDevice(module);
  bindMadeSurface(module);
  bindHalfSpace(module);
  bindStation(module);
  bindBeams(module);
}
