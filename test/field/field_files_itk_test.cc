// ITK reads the fields that we write, and maps points as the warp does.
#include <ceres_ed/graph/space_warp.h>
#include <ceres_ed/io/field/grid_reader.h>
#include <ceres_ed/pipeline/apply/field_run.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <test/field/itk_oracle.h>
#include <test/geometry/meshes.h>
#include <test/graph/warp_examples.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

#define SKIP_WITHOUT_ITK()                                                                  \
  if (!HaveItk()) {                                                                         \
    GTEST_SKIP() << "these tests were built without ITK (Debian's libinsighttoolkit5-dev)"; \
  }

ItkPoint Plain(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

// Returns where ITK maps a point with the transform in the file.
Eigen::Vector3d MapPointByItk(const std::string& path, const Eigen::Vector3d& point) {
  const ItkPoint mapped = MapByItk(path, {Plain(point)})[0];
  return Eigen::Vector3d(mapped.data());
}

ItkGrid Plain(const FieldGrid& grid) {
  ItkGrid plain = {grid.size, Plain(grid.origin), Plain(grid.spacing), {}};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) plain.direction[3 * r + c] = grid.direction(r, c);
  }
  return plain;
}

// What ITK makes of a point of our surfaces: its coordinates are left-posterior-superior, in mm.
Eigen::Vector3d ToItkFrame(SurfaceAxes axes, SurfaceUnit unit, const Eigen::Vector3d& p) {
  const double mm = unit == SurfaceUnit::kMetres ? 1000.0 : 1.0;
  if (axes == SurfaceAxes::kLps) return mm * p;
  return mm * Eigen::Vector3d(-p.x(), -p.y(), p.z());
}

Similarity QuarterTurn() {
  Similarity similarity;
  similarity.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitZ()));
  similarity.translation = {4.0, -1.0, 0.5};
  return similarity;
}

// A smooth deformation of the cube [0, 3]^3 behind a placement that no symmetry hides.
Warp MakeSmoothWarp() {
  Warp warp = MakeBendingWarp(4, 0.12);
  warp.target_from_source.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()));
  warp.target_from_source.translation = {2.0, 5.0, -3.0};
  return warp;
}

void Write(const FieldSettings& settings, const Warp& warp) {
  FieldObserver silent;
  const Outcome outcome = RunField(settings, "w.json", warp, nullptr, &silent);
  ASSERT_TRUE(outcome.done()) << outcome.message;
}

// Returns points in the cube of the nodes.
std::vector<Eigen::Vector3d> PointsInCube() {
  std::vector<Eigen::Vector3d> points = RandomPoints(300, 21);
  for (Eigen::Vector3d& p : points) p = 1.5 * p + Eigen::Vector3d::Constant(1.5);
  return points;
}

// Returns by how much ITK's transform from the file misses, in spacings, over points between those
// of the grid.
double WorstError(const Warp& warp, const FieldSettings& settings) {
  const auto space = *SpaceWarp::Create(warp);
  std::vector<ItkPoint> from;
  std::vector<Eigen::Vector3d> to;
  for (const Eigen::Vector3d& x : PointsInCube()) {
    from.push_back(
        Plain(ToItkFrame(settings.frame, settings.unit, settings.inverse ? (*space)(x) : x)));
    to.push_back(ToItkFrame(settings.frame, settings.unit, settings.inverse ? x : (*space)(x)));
  }
  const std::vector<ItkPoint> mapped = MapByItk(settings.field, from);
  double worst = 0.0;
  for (std::size_t p = 0; p < to.size(); ++p) {
    worst = std::max(worst, (Eigen::Vector3d(mapped[p].data()) - to[p]).norm());
  }
  const double mm = settings.unit == SurfaceUnit::kMetres ? 1000.0 : 1.0;
  return worst / (mm * settings.spacing);
}

void ExpectItkAgrees(const std::string& ending) {
  SKIP_WITHOUT_ITK();
  const TemporaryDirectory directory;
  const Warp warp = MakeSmoothWarp();
  FieldSettings settings;
  settings.field = directory / ("field" + ending);
  settings.spacing = 0.1;
  settings.margin = 0.3;
  for (const bool inverse : {false, true}) {
    for (const SurfaceAxes axes : {SurfaceAxes::kLps, SurfaceAxes::kRas}) {
      settings.inverse = inverse;
      settings.frame = axes;
      Write(settings, warp);
      EXPECT_LT(WorstError(warp, settings), 0.01) << inverse << " " << NameOf(axes);
    }
  }
  // Metres become millimetres.
  settings.unit = SurfaceUnit::kMetres;
  Write(settings, warp);
  EXPECT_LT(WorstError(warp, settings), 0.01);
}

TEST(NrrdField, MapsPointsInItkAsTheWarpDoes) { ExpectItkAgrees(".nrrd"); }
TEST(NiftiField, MapsPointsInItkAsTheWarpDoes) { ExpectItkAgrees(".nii"); }
TEST(NiftiGzField, MapsPointsInItkAsTheWarpDoes) { ExpectItkAgrees(".nii.gz"); }
TEST(MhaField, MapsPointsInItkAsTheWarpDoes) { ExpectItkAgrees(".mha"); }
TEST(MhdField, MapsPointsInItkAsTheWarpDoes) { ExpectItkAgrees(".mhd"); }

#ifdef CERES_ED_HAVE_HDF5_MODULE
TEST(ItkHdf5Field, MapsPointsInItkAsTheWarpDoes) { ExpectItkAgrees(".h5"); }
#endif

// A quarter turn has another result if the field is taken backwards, if an axis has the wrong sign
// or if components and axes are exchanged.
TEST(FieldFiles, TurnPointsInItkByAQuarterTheRightWay) {
  SKIP_WITHOUT_ITK();
  const TemporaryDirectory directory;
  const Similarity turn = QuarterTurn();
  FieldSettings settings;
  settings.spacing = 0.5;
  const Eigen::Vector3d x(0.3, 1.1, 0.7);
  ASSERT_LT((turn * x - Eigen::Vector3d(2.9, -0.7, 1.2)).norm(), 1e-12);
  for (const std::string ending : {".nrrd", ".nii.gz", ".mha", ".mhd"}) {
    settings.field = directory / ("turn" + ending);
    settings.inverse = false;
    settings.frame = SurfaceAxes::kLps;
    Write(settings, MakeSimilarityWarp(turn));
    EXPECT_LT((MapPointByItk(settings.field, x) - turn * x).norm(), 1e-6) << ending;
    // In right-anterior-superior coordinates the same numbers are another point.
    settings.frame = SurfaceAxes::kRas;
    Write(settings, MakeSimilarityWarp(turn));
    const Eigen::Vector3d in_itk = MapPointByItk(settings.field, {-0.3, -1.1, 0.7});
    EXPECT_LT((in_itk - Eigen::Vector3d(-2.9, 0.7, 1.2)).norm(), 1e-6) << ending;
    settings.inverse = true;
    Write(settings, MakeSimilarityWarp(turn));
    const Eigen::Vector3d back = MapPointByItk(settings.field, {-2.9, 0.7, 1.2});
    EXPECT_LT((back - Eigen::Vector3d(-0.3, -1.1, 0.7)).norm(), 1e-6) << ending;
  }
}

TEST(FieldFiles, AreExactInItkAtThePointsOfTheGrid) {
  SKIP_WITHOUT_ITK();
  const TemporaryDirectory directory;
  const Warp warp = MakeSmoothWarp();
  const auto space = *SpaceWarp::Create(warp);
  FieldSettings settings;
  settings.field = directory / "field.nrrd";
  settings.bounds = "0,2,0.5,2,1,2";
  settings.spacing = 0.5;
  Write(settings, warp);
  // Corners of the box may be outside by rounding.
  for (const Eigen::Vector3d& x :
       {Eigen::Vector3d(0.5, 1.0, 1.5), Eigen::Vector3d(1.5, 1.5, 1.5)}) {
    EXPECT_LT((MapPointByItk(settings.field, x) - (*space)(x)).norm(), 1e-6);
  }
}

TEST(FieldFiles, ResampleAnImageOfTheSourceOntoTheTarget) {
  SKIP_WITHOUT_ITK();
  const TemporaryDirectory directory;
  const Warp warp = MakeSmoothWarp();
  const auto space = *SpaceWarp::Create(warp);
  const Eigen::Vector3d center(1.2, 1.9, 1.4);
  const Eigen::Vector3d moved = (*space)(center);
  FieldGrid image;
  image.size = {60, 80, 70};
  image.spacing.setConstant(0.12);
  image.origin = center.cwiseMin(moved) - Eigen::Vector3d::Constant(1.0);
  FieldSettings settings;
  settings.field = directory / "field.nii.gz";
  settings.inverse = true;
  // Outside its grid a field moves nothing, so it has to cover the image.
  settings.like = directory / "image.mha";
  WriteImageByItk(settings.like, Plain(image));
  Write(settings, warp);
  const ItkPoint found = ResampleBallByItk(settings.field, Plain(image), Plain(center), 0.5);
  EXPECT_LT((Eigen::Vector3d(found.data()) - moved).norm(), 0.03);
}

// All of space is moved to the plane z = 0; no other point has an inverse.
TEST(FieldFiles, LeaveAnImageOfItkEmptyWhereThereIsNoInverse) {
  SKIP_WITHOUT_ITK();
  const TemporaryDirectory directory;
  Warp warp = MakeLatticeWarp(3, 0.0, 0.0);
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    MutableNodeAffine(warp.state.node(j)) = Eigen::Vector3d(1, 1, 0).asDiagonal();
    MutableNodeTranslation(warp.state.node(j)) = Eigen::Vector3d(0, 0, -warp.graph.position(j).z());
  }
  FieldGrid image;
  image.size = {9, 9, 9};
  image.spacing.setConstant(0.25);
  image.origin = {0.0, 0.0, 0.5};
  FieldSettings settings;
  settings.field = directory / "field.nrrd";
  settings.inverse = true;
  settings.like = directory / "image.mha";
  WriteImageByItk(settings.like, Plain(image));
  Write(settings, warp);
  // The centre of nothing.
  const ItkPoint center = Plain(image.Position(4, 4, 4));
  EXPECT_TRUE(std::isnan(ResampleBallByItk(settings.field, Plain(image), center, 0.6)[0]));
}

TEST(RigidFile, IsTheTransformWithWhichItkResamples) {
  SKIP_WITHOUT_ITK();
  const TemporaryDirectory directory;
  Warp warp = MakeSmoothWarp();
  warp.target_from_source.scale = 1.3;
  FieldSettings settings;
  settings.rigid = directory / "rigid.tfm";
  for (const SurfaceAxes axes : {SurfaceAxes::kLps, SurfaceAxes::kRas}) {
    for (const SurfaceUnit unit : {SurfaceUnit::kMillimetres, SurfaceUnit::kMetres}) {
      settings.frame = axes;
      settings.unit = unit;
      Write(settings, warp);
      for (const Eigen::Vector3d& x : PointsInCube()) {
        const Eigen::Vector3d expected = ToItkFrame(axes, unit, x);
        const Eigen::Vector3d y = ToItkFrame(axes, unit, warp.target_from_source * x);
        EXPECT_LT((MapPointByItk(settings.rigid, y) - expected).norm(), 1e-9 * y.norm());
      }
    }
  }
}

// A grid that is oblique and has three spacings.
FieldGrid ObliqueGrid() {
  FieldGrid grid;
  grid.size = {11, 7, 5};
  grid.spacing = {0.5, 0.7, 1.25};
  grid.origin = {-3.0, 8.0, 2.5};
  grid.direction =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(2, 1, -1).normalized()).toRotationMatrix();
  return grid;
}

void ExpectSameGrid(const ItkGrid& a, const ItkGrid& b) {
  EXPECT_EQ(a.size, b.size);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(a.origin[i], b.origin[i], 1e-5);
    EXPECT_NEAR(a.spacing[i], b.spacing[i], 1e-6);
  }
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(a.direction[i], b.direction[i], 1e-5);
}

TEST(GridReader, FindsTheGridOfImagesOfItk) {
  SKIP_WITHOUT_ITK();
  const TemporaryDirectory directory;
  for (const std::string ending : {".nrrd", ".nii", ".nii.gz", ".mha", ".mhd"}) {
    const std::string path = directory / ("image" + ending);
    WriteImageByItk(path, Plain(ObliqueGrid()));
    const StatusOr<FieldGrid> grid = ReadGrid(path);
    ASSERT_TRUE(grid.ok()) << grid.status().message();
    ExpectSameGrid(Plain(*grid), ReadGridByItk(path));
    ExpectSameGrid(Plain(*grid), Plain(ObliqueGrid()));
  }
}

TEST(FieldFiles, LieOnTheGridOfAnImage) {
  SKIP_WITHOUT_ITK();
  const TemporaryDirectory directory;
  FieldSettings settings;
  settings.like = directory / "image.nii.gz";
  WriteImageByItk(settings.like, Plain(ObliqueGrid()));
  const Similarity turn = QuarterTurn();
  settings.frame = SurfaceAxes::kRas;
  // A point in the middle of the grid, in right-anterior-superior coordinates.
  const Eigen::Vector3d middle = ObliqueGrid().Position(4, 3, 2);
  const Eigen::Vector3d x(-middle.x(), -middle.y(), middle.z());
  for (const std::string ending : {".nrrd", ".nii", ".mha"}) {
    settings.field = directory / ("field" + ending);
    Write(settings, MakeSimilarityWarp(turn));
    ExpectSameGrid(ReadGridByItk(settings.field), Plain(ObliqueGrid()));
    const Eigen::Vector3d expected = ToItkFrame(settings.frame, settings.unit, turn * x);
    EXPECT_LT((MapPointByItk(settings.field, middle) - expected).norm(), 1e-5) << ending;
  }
}

}  // namespace
}  // namespace ceres_ed
