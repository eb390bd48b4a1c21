// The class Tracker.
#ifndef CERES_ED_PYTHON_TRACKER_H_
#define CERES_ED_PYTHON_TRACKER_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/results/map_ply.h>
#include <ceres_ed/python/energies.h>
#include <ceres_ed/slam/slam.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace ceres_ed::python {

namespace py = pybind11;

// A DeformableSlam that takes arrays and works without the interpreter's lock.
class Tracker {
 public:
  Tracker(const PinholeCamera& camera,
          const SlamOptions* options,
          const py::object& energies,
          const py::object& plugin,
          const py::kwargs& changes);

  // Processes a frame. See the docstring of `track` for the arguments.
  FrameReport Track(const py::object& depth,
                    const py::object& color,
                    const py::object& pose,
                    std::optional<double> units_per_metre,
                    std::optional<int> number,
                    bool catch_up);
  // Returns all points in "map" or "camera" coordinates, and the warp, after CatchUp().
  MapSnapshot Snapshot(const std::string& frame);
  Warp MakeWarp();
  // Returns the pose of the camera in the map, in metres; nothing before the first frame.
  std::optional<Similarity> CameraPose() const;
  // Returns for each node whether it had data in the last tracked frame, or was added in it.
  py::array PointRelevant() const;
  int NumPoints() const;

 private:
  // Prevents the use of the tracker by two threads. Raises a RuntimeError if another thread, which
  // has released the interpreter's lock, uses the tracker. Waiting with the lock would be a
  // deadlock, because the other thread needs the lock to finish.
  class Turn {
   public:
    explicit Turn(bool* busy) : busy_(busy) {
      if (*busy) throw std::runtime_error("the tracker is in use by another thread");
      *busy = true;
    }
    ~Turn() { *busy_ = false; }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    bool* busy_;
  };

  void CheckSize(const py::array& image, const char* what) const;
  py::array_t<float, py::array::c_style> Metres(const py::object& depth,
                                                std::optional<double> units_per_metre) const;
  void CatchUp();

  PinholeCamera camera_;
  bool camera_is_given_ = false;
  EnergyArguments energies_;
  std::unique_ptr<DeformableSlam> slam_;
  int next_number_ = 0;
  // It is only read and written with the interpreter's lock.
  mutable bool busy_ = false;
};

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_TRACKER_H_
