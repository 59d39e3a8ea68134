#include <pybind11/numpy.h>

#include "python/core/arrays.hpp"
#include "python/core/bindings.hpp"
#include "python/core/histories.hpp"

namespace py = pybind11;

namespace boresight::python {
namespace {

template <typename Of>
py::array pose_column(const BodyHistoryView& h, const Of& of, py::ssize_t width) {
  const auto& samples = h.body->samples;
  return column(h.owner, samples, samples.empty() ? nullptr : of(samples.front()), width, h.every);
}

}  // namespace

void bind_histories(py::module_& module) {
  py::class_<BodyHistoryView>(
      module, "BodyHistory",
      "The motion of one body, world axes unless said otherwise. n: the samples of Run.time. Arrays cannot be "
      "written to; none is a copy.")
      .def_property_readonly("body", [](const BodyHistoryView& h) { return h.body->name; })
      .def_property_readonly(
          "position",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.pose.p.data(); }, 3);
          },
          "Of its centre of mass, (n, 3) [m].")
      .def_property_readonly(
          "orientation",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.pose.q.coeffs().data(); }, 4);
          },
          "From body to world, a quaternion x, y, z, w as SciPy has it, (n, 4).")
      .def_property_readonly(
          "ideal_position",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.ideal.p.data(); }, 3);
          },
          "Where it would be without play and errors, (n, 3) [m].")
      .def_property_readonly(
          "ideal_orientation",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.ideal.q.coeffs().data(); }, 4);
          },
          "How it would be turned, x, y, z, w, (n, 4).")
      .def_property_readonly(
          "displacement",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.error.displacement.data(); }, 3);
          },
          "Error of the position, (n, 3) [m].")
      .def_property_readonly(
          "rotation",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.error.rotation.data(); }, 3);
          },
          "Error of the orientation, rotation vector from ideal to true, (n, 3) [rad].")
      .def_property_readonly(
          "position_error",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return &s.error.position; }, 1);
          },
          "(n,) [m]")
      .def_property_readonly(
          "orientation_error",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return &s.error.orientation; }, 1);
          },
          "(n,) [rad]")
      .def_property_readonly(
          "boresight_error",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return &s.error.boresight; }, 1);
          },
          "(n,) [rad]")
      .def_property_readonly(
          "line_of_sight_error",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return &s.error.line_of_sight; }, 1);
          },
          "(n,) [rad]; zero where nothing is sighted.")
      .def_property_readonly(
          "velocity",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.v.data(); }, 3);
          },
          "(n, 3) [m/s]")
      .def_property_readonly(
          "angular_velocity",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.w.data(); }, 3);
          },
          "(n, 3) [rad/s]")
      .def_property_readonly(
          "acceleration",
          [](const BodyHistoryView& h) {
            return pose_column(
                h, [](const PoseSample& s) { return s.a.data(); }, 3);
          },
          "Of the centre of mass, (n, 3) [m/s^2].");

  py::class_<ClearanceHistoryView>(module, "ClearanceHistory",
                                   "The play of one joint over time. n: the samples of Run.time.")
      .def_readonly("joint", &ClearanceHistoryView::joint)
      .def_property_readonly(
          "offset",
          [](const ClearanceHistoryView& h) {
            return column(h.owner, *h.samples, h.samples->empty() ? nullptr : h.samples->front().offset.data(), 3,
                          h.every);
          },
          "Journal from sleeve centre, sleeve frame, y along the axis, (n, 3) [m].")
      .def_property_readonly(
          "penetration",
          [](const ClearanceHistoryView& h) {
            return column(h.owner, *h.samples, h.samples->empty() ? nullptr : &h.samples->front().penetration, 1,
                          h.every);
          },
          "Of the deepest contact, (n,) [m]; negative: the smallest gap.")
      .def_property_readonly(
          "normal_force",
          [](const ClearanceHistoryView& h) {
            return column(h.owner, *h.samples, h.samples->empty() ? nullptr : &h.samples->front().normal_force, 1,
                          h.every);
          },
          "Sum over its contacts, (n,) [N].")
      .def_property_readonly(
          "contact",
          [](const ClearanceHistoryView& h) {
            return column(h.owner, *h.samples, h.samples->empty() ? nullptr : &h.samples->front().contact, 1, h.every);
          },
          "(n,): 0 free, 1 radial, 2 axial, 3 both.");
}

}  // namespace boresight::python
