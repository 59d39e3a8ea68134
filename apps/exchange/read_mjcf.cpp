#include "boresight/mechanism/error.hpp"
#include "exchange/readers.hpp"
#include "exchange/utf8.hpp"

#ifndef BORESIGHT_HAS_MUJOCO

namespace boresight::app {

Drawing read_mjcf(const std::string& filename) {
  throw InputError({filename, 0}, "mujoco", "a file of MuJoCo",
                   "URDF or SDF: this program was built without MuJoCo (libmujoco-dev), which compiles MJCF");
}

}  // namespace boresight::app

#else

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <array>
#include <map>
#include <memory>

namespace boresight::app {
namespace {

// MuJoCo writes warnings into a file of its own where nobody takes them.
void ignore(const char*) {}
// Where it cannot go on, it would wait for a key and end the program.
void give_up(const char* why) { throw ComputationError(std::string("MuJoCo: ") + why); }

Vec3 vec3(const mjtNum* v) { return {v[0], v[1], v[2]}; }
Mat3 mat3(const mjtNum* m) { return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m); }

class MjcfReader {
 public:
  explicit MjcfReader(const std::string& filename) : model_(nullptr, mj_deleteModel), data_(nullptr, mj_deleteData) {
    drawing_.file = filename;
    drawing_.format = "MJCF";
    mju_user_warning = ignore;
    mju_user_error = give_up;
    std::array<char, 1000> fault = {};
    model_.reset(mj_loadXML(filename.c_str(), nullptr, fault.data(), static_cast<int>(fault.size())));
    if (!model_) throw refused(fault.data());
    data_.reset(mj_makeData(model_.get()));
    mj_kinematics(model_.get(), data_.get());  // at qpos0
  }

  Drawing read() {
    const mjModel& m = *model_;
    drawing_.name = name_of(0, "");  // the model's comes first
    // What flags switch off is not there, whatever stands elsewhere.
    const auto off = [&m](int flags) { return (m.opt.disableflags & flags) != 0; };
    drawing_.gravity = off(mjDSBL_GRAVITY) ? Vec3(Vec3::Zero()) : vec3(m.opt.gravity);
    read_bodies();
    read_drives();
    for (int body = 1; body < m.nbody; ++body) connect(body);
    if (!off(mjDSBL_EQUALITY | mjDSBL_CONSTRAINT))
      read_equalities();
    else if (m.neq > 0)
      leave_out("equalities, which a flag disables");
    if (!off(mjDSBL_PASSIVE))
      read_springs();
    else if (m.ntendon > 0)
      leave_out("tendons, which a flag disables");
    name_the_rest();
    return std::move(drawing_);
  }

 private:
  // MuJoCo's own words, in one line, with the line that they name.
  InputError refused(std::string words) const {
    for (char& c : words)
      if (c == '\n') c = ' ';
    int line = 0;
    const std::size_t at = words.find("line ");
    if (at != std::string::npos) line = std::atoi(words.c_str() + at + 5);
    return {
        {drawing_.file, line}, "mujoco", "what MuJoCo does not compile (" + words + ")", "a model that it compiles"};
  }

  std::string name_of(int address, const std::string& otherwise) const {
    const std::string name = model_->names + address;
    if (const std::size_t at = first_byte_not_utf8(name); at != std::string::npos)
      throw InputError({drawing_.file, 0}, "name", byte_in_words(name[at]), "UTF-8: save the file as that");
    return name.empty() ? otherwise : name;
  }
  std::string body_name(int body) const { return name_of(model_->name_bodyadr[body], fmt::format("body{}", body)); }
  std::string joint_name(int joint) const {
    const int body = model_->jnt_bodyid[joint];
    return name_of(model_->name_jntadr[joint],
                   fmt::format("{} joint {}", body_name(body), joint - model_->body_jntadr[body] + 1));
  }
  static int part_of(int body) { return body == 0 ? kGround : body - 1; }

  void read_bodies() {
    for (int body = 1; body < model_->nbody; ++body) {
      Part& part = drawing_.parts.emplace_back();
      part.name = body_name(body);
      part.origin = {drawing_.file, 0};
      part.X_WP = {mat3(data_->xmat + 9 * body), vec3(data_->xpos + 3 * body)};
      part.mass = model_->body_mass[body];
      part.p_WC = vec3(data_->xipos + 3 * body);
      const Mat3 R_WI = mat3(data_->ximat + 9 * body);
      part.inertia = R_WI * vec3(model_->body_inertia + 3 * body).asDiagonal() * R_WI.transpose();
    }
  }

  void read_drives() {
    if (model_->nu == 0)
      drawing_.drives = "no joint is driven: the file has no actuator; --drive names joints that are";
    for (int a = 0; a < model_->nu; ++a) {
      const int type = model_->actuator_trntype[a], target = model_->actuator_trnid[2 * a];
      if (type == mjTRN_JOINT || type == mjTRN_JOINTINPARENT)
        driven_[target] = true;
      else
        leave_out(name_of(model_->name_actuatoradr[a], "an actuator") + ": an actuator that drives no joint");
    }
  }

  // What the joints of a body, together, leave it.
  void connect(int body) {
    const int n = model_->body_jntnum[body], first = model_->body_jntadr[body];
    Connection made;
    made.first = part_of(model_->body_parentid[body]);
    made.second = part_of(body);
    made.origin = {drawing_.file, 0};
    if (n == 0) {
      made.type = JointType::fixed;
      made.name = body_name(body) + " fixed";
      drawing_.connections.push_back(made);
      return;
    }
    std::vector<int> hinges, slides;
    bool driven = false;
    for (int j = first; j < first + n; ++j) {
      if (model_->jnt_type[j] == mjJNT_FREE) return;
      if (model_->jnt_type[j] == mjJNT_BALL) made.type = JointType::spherical;
      if (model_->jnt_type[j] == mjJNT_HINGE) hinges.push_back(j);
      if (model_->jnt_type[j] == mjJNT_SLIDE) slides.push_back(j);
      name_extras(j);
      driven = driven || driven_.count(j) != 0;
    }
    place(first, made);
    if (n == 1) {
      made.driven = driven && made.type != JointType::spherical;
      if (driven && !made.driven) leave_out(made.name + ": the actuator of a ball");
      drawing_.connections.push_back(made);
    } else if (!driven && hinges.size() + slides.size() == static_cast<std::size_t>(n) &&
               is_one_joint(hinges, slides, made)) {
      drawing_.connections.push_back(made);
    } else {
      chain(body, made.first);
    }
  }

  // Name, place and axis of one joint; its type, but for a ball's.
  void place(int joint, Connection& made) const {
    made.name = joint_name(joint);
    made.p_WJ = vec3(data_->xanchor + 3 * joint);
    made.axis = vec3(data_->xaxis + 3 * joint).normalized();
    made.type = model_->jnt_type[joint] == mjJNT_BALL    ? JointType::spherical
                : model_->jnt_type[joint] == mjJNT_SLIDE ? JointType::prismatic
                                                         : JointType::revolute;
  }

  // One joint after the other, with frames without mass between them.
  void chain(int body, int parent) {
    const int first = model_->body_jntadr[body], last = first + model_->body_jntnum[body] - 1;
    for (int j = first; j <= last; ++j) {
      Connection made;
      made.origin = {drawing_.file, 0};
      place(j, made);
      made.driven = driven_.count(j) != 0 && made.type != JointType::spherical;
      made.first = parent;
      made.second = part_of(body);
      if (j < last) {
        Part between;
        between.name = body_name(body) + " after " + made.name;
        between.origin = made.origin;
        between.X_WP = drawing_.parts[part_of(body)].X_WP;
        between.p_WC = made.p_WJ;
        made.second = parent = static_cast<int>(drawing_.parts.size());
        drawing_.parts.push_back(between);
      }
      drawing_.connections.push_back(made);
    }
  }

  // Whether several joints without actuators are one of a mechanism file, which one.
  bool is_one_joint(const std::vector<int>& hinges, const std::vector<int>& slides, Connection& made) {
    const auto axis = [&](int joint) { return vec3(data_->xaxis + 3 * joint).normalized().eval(); };
    const auto anchor = [&](int joint) { return vec3(data_->xanchor + 3 * joint); };
    constexpr double kSame = 1e-9;
    const auto across = [&](int a, int b) { return std::abs(axis(a).dot(axis(b))) < kSame; };
    const auto along = [&](int a, int b) { return axis(a).cross(axis(b)).norm() < kSame; };
    const auto meet = [&](int a, int b) { return (anchor(a) - anchor(b)).norm() < kSame; };
    const auto h = hinges.size(), s = slides.size();
    if (h == 1 && s == 1 && along(hinges[0], slides[0])) {
      made.type = JointType::cylindrical;
      made.p_WJ = anchor(hinges[0]);
    } else if (h == 2 && s == 0 && across(hinges[0], hinges[1]) && meet(hinges[0], hinges[1])) {
      made.type = JointType::universal;
      made.second_axis = axis(hinges[1]);
    } else if (h == 3 && s == 0 && meet(hinges[0], hinges[1]) && meet(hinges[0], hinges[2]) &&
               std::abs(axis(hinges[0]).cross(axis(hinges[1])).dot(axis(hinges[2]))) > 0.1) {
      made.type = JointType::spherical;
    } else if (h == 1 && s == 2 && across(hinges[0], slides[0]) && across(hinges[0], slides[1]) &&
               !along(slides[0], slides[1])) {
      made.type = JointType::planar;
      made.p_WJ = anchor(hinges[0]);
      made.axis = axis(hinges[0]);
    } else {
      return false;
    }
    return true;
  }

  void name_extras(int joint) {
    const int dof = model_->jnt_dofadr[joint];
    if (model_->jnt_stiffness[joint] != 0.0) leave_out(joint_name(joint) + ": its spring");
    if (model_->dof_damping[dof] != 0.0 || model_->dof_frictionloss[dof] != 0.0)
      leave_out(joint_name(joint) + ": its damping or friction");
    if (model_->dof_armature[dof] != 0.0) leave_out(joint_name(joint) + ": its armature (the rotor's inertia)");
    const mjtNum at = model_->qpos0[model_->jnt_qposadr[joint]];
    if ((model_->jnt_type[joint] == mjJNT_HINGE || model_->jnt_type[joint] == mjJNT_SLIDE) && at != 0.0)
      leave_out(fmt::format("{}: its ref of {:.6g} {}: its course counts from the pose that the file draws",
                            joint_name(joint), at, model_->jnt_type[joint] == mjJNT_HINGE ? "rad" : "m"));
    if (model_->jnt_limited[joint]) leave_out("limits of joints: they go where [motion] says");
  }

  // Of every equality: how far it is from being closed as the file draws the bodies, metres and radians alike.
  std::vector<double> open_equalities() {
    std::vector<double> open(static_cast<std::size_t>(model_->neq), 0.0);
    mj_fwdPosition(model_.get(), data_.get());
    for (int row = 0; row < data_->nefc; ++row)
      if (data_->efc_type[row] == mjCNSTR_EQUALITY) {
        double& most = open[static_cast<std::size_t>(data_->efc_id[row])];
        most = std::max(most, std::abs(data_->efc_pos[row]));
      }
    return open;
  }

  void read_equalities() {
    constexpr double kClosed = 1e-6;
    const std::vector<double> open = open_equalities();
    for (int e = 0; e < model_->neq; ++e) {
      const std::string name = name_of(model_->name_eqadr[e], fmt::format("equality {}", e + 1));
      const int type = model_->eq_type[e], a = model_->eq_obj1id[e], b = model_->eq_obj2id[e];
      if (!model_->eq_active[e] || (type != mjEQ_CONNECT && type != mjEQ_WELD)) {
        leave_out(name + ": " + (model_->eq_active[e] ? "an equality that ties no two bodies" : "it is not active"));
        continue;
      }
      if (open[static_cast<std::size_t>(e)] > kClosed)
        leave_out(name + ": the pose that it asks for (relpose): the bodies are joined as the file draws them");
      Connection made;
      made.name = name;
      made.type = type == mjEQ_WELD ? JointType::fixed : JointType::spherical;
      made.first = part_of(a);
      made.second = part_of(b);
      made.origin = {drawing_.file, 0};
      made.p_WJ = mat3(data_->xmat + 9 * a) * vec3(model_->eq_data + mjNEQDATA * e) + vec3(data_->xpos + 3 * a);
      drawing_.connections.push_back(made);
    }
  }

  // A tendon between two sites with a stiffness is a spring.
  void read_springs() {
    for (int t = 0; t < model_->ntendon; ++t) {
      const int at = model_->tendon_adr[t];
      const std::string name = name_of(model_->name_tendonadr[t], fmt::format("tendon {}", t + 1));
      const bool straight = model_->tendon_num[t] == 2 && model_->wrap_type[at] == mjWRAP_SITE &&
                            model_->wrap_type[at + 1] == mjWRAP_SITE;
      if (!straight || (model_->tendon_stiffness[t] == 0.0 && model_->tendon_damping[t] == 0.0)) {
        leave_out(name + ": a tendon that is no spring between two points");
        continue;
      }
      const int first = model_->wrap_objid[at], second = model_->wrap_objid[at + 1];
      SpringDescription& spring = drawing_.springs.emplace_back();
      spring.first = part_of(model_->site_bodyid[first]);
      spring.second = part_of(model_->site_bodyid[second]);
      spring.first_point = vec3(data_->site_xpos + 3 * first);
      spring.second_point = vec3(data_->site_xpos + 3 * second);
      spring.parameters.stiffness = model_->tendon_stiffness[t];
      spring.parameters.damping = model_->tendon_damping[t];
      const double length = model_->tendon_lengthspring[t];
      spring.parameters.free_length = length >= 0.0 ? length : (spring.second_point - spring.first_point).norm();
    }
  }

  void name_the_rest() {
    if (model_->nexclude > 0 || model_->npair > 0) leave_out("contacts between bodies");
    for (int g = 0, contacts = 0; g < model_->ngeom; ++g)
      if ((model_->geom_contype[g] != 0 || model_->geom_conaffinity[g] != 0) && contacts++ == 0)
        leave_out("contacts between bodies, and their shapes");
    if (model_->opt.density != 0.0 || model_->opt.viscosity != 0.0) leave_out("the drag of the medium");
  }

  void leave_out(const std::string& what) { drawing_.left_out.push_back({0, what}); }

  Drawing drawing_;
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
  std::map<int, bool> driven_;
};

}  // namespace

Drawing read_mjcf(const std::string& filename) { return MjcfReader(filename).read(); }

}  // namespace boresight::app

#endif
