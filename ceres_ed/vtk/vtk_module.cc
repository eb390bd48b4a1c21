// Surfaces in the files of VTK, for programs that load this module when such a file is named.
#include <ceres_ed/io/mesh/format_content.h>
#include <ceres_ed/io/mesh/mesh_module.h>
#include <ceres_ed/io/mesh/mesh_space.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/version.h>
#include <ceres_ed/vtk/document_from_vtk.h>
#include <ceres_ed/vtk/trial_run.h>
#include <ceres_ed/vtk/vtk_from_document.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <string>
#include <utility>

#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

namespace ceres_ed {
namespace {

// Keeps VTK's messages, which it would print.
class Messages : public vtkOutputWindow {
 public:
  static Messages* New();
  vtkTypeMacro(Messages, vtkOutputWindow);
  void DisplayText(const char* /*text*/) override {}
  void DisplayErrorText(const char* text) override { Keep(text); }
  void DisplayWarningText(const char* text) override { Keep(text); }
  void DisplayGenericWarningText(const char* text) override { Keep(text); }

  // The first message, in one line.
  const std::string& first() const { return first_; }

 private:
  void Keep(const char* text) {
    if (!first_.empty() || text == nullptr) return;
    std::string message = text;
    // Ahead of the sentence VTK names its source file, the object and its address.
    const std::size_t address = message.find("): ");
    if (address != std::string::npos) message.erase(0, address + 3);
    for (char& c : message) c = static_cast<unsigned char>(c) < ' ' || c == 0x7f ? ' ' : c;
    message.erase(message.find_last_not_of(' ') + 1);
    first_ = message.substr(0, 200);
  }

  std::string first_;
};
vtkStandardNewMacro(Messages);

// Collects messages while it lives.
class MessageScope {
 public:
  MessageScope() : before_(vtkOutputWindow::GetInstance()) {
    // The log would repeat the messages.
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::SetInstance(own_);
  }
  ~MessageScope() { vtkOutputWindow::SetInstance(before_); }
  MessageScope(const MessageScope&) = delete;
  MessageScope& operator=(const MessageScope&) = delete;
  const std::string& first() const { return own_->first(); }

 private:
  vtkNew<Messages> own_;
  vtkSmartPointer<vtkOutputWindow> before_;
};

constexpr char kSpaceArray[] = "SPACE";

Status Damaged(const std::string& path, const std::string& message) {
  return Status::Error(path + ": VTK cannot read it as a surface (poly data)" +
                       (message.empty() ? "" : ": " + message));
}

struct FileStart {
  std::size_t size = 0;
  std::string bytes;
};

StatusOr<FileStart> ReadStart(const std::string& path) {
  std::ifstream file;
  const StatusOr<std::size_t> size = OpenRegularFile(path, &file);
  if (!size.ok()) return size.status();
  constexpr std::size_t kStart = 4096;
  FileStart start{*size, std::string(std::min(*size, kStart), '\0')};
  file.read(start.bytes.data(), static_cast<std::streamsize>(start.bytes.size()));
  return start;
}

// Names the corner of a cell that is no point; VTK itself does not look.
Status CheckCells(const std::string& path, vtkPolyData* surface) {
  const vtkIdType count = surface->GetNumberOfPoints();
  for (vtkCellArray* const cells :
       {surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips()}) {
    const vtkNew<vtkIdList> points;
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
      cells->GetCellAtId(i, points);
      for (vtkIdType c = 0; c < points->GetNumberOfIds(); ++c) {
        if (points->GetId(c) >= 0 && points->GetId(c) < count) continue;
        return Status::Error(path + ": a cell names point " + std::to_string(points->GetId(c)) +
                             ", the file has " + std::to_string(count));
      }
    }
  }
  return Status::Ok();
}

vtkSmartPointer<vtkPolyData> ReadXml(const std::string& path) {
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkPolyData> ReadLegacy(const std::string& path) {
  const vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  reader->ReadAllColorScalarsOn();
  reader->Update();
  return reader->GetOutput();
}

using Reader = vtkSmartPointer<vtkPolyData> (*)(const std::string& path);

// Returns whether VTK can read a file of that size without an end of the process, and in a memory
// that its numbers can explain: an error of VTK about memory is no end of its own.
bool IsReadSafely(Reader read, const std::string& path, std::size_t size) {
  // A number of an ascii file has two bytes, and takes up to eight, and as much while arrays grow.
  constexpr std::size_t kBytesPerByte = 32;
  constexpr std::size_t kLeast = std::size_t{512} << 20U;
  const auto trial = [&] {
    const MessageScope messages;
    read(path);
    return messages.first().find("llocat") == std::string::npos;
  };
  return EndsWell(trial, kLeast + kBytesPerByte * size);
}

Status ReadVtkFile(const std::string& path, PlyDocument* document) {
  const StatusOr<FileStart> start = ReadStart(path);
  if (!start.ok()) return start.status();
  const Reader read = IsVtp(start->bytes, start->bytes.size()) ? ReadXml : ReadLegacy;
  if (!IsReadSafely(read, path, start->size)) return Damaged(path, "it is truncated or damaged");
  const MessageScope messages;
  try {
    const vtkSmartPointer<vtkPolyData> surface = read(path);
    if (surface == nullptr || !messages.first().empty()) return Damaged(path, messages.first());
    if (Status status = CheckCells(path, surface); !status.ok()) return status;
    *document = DocumentFromVtk(surface);
    // 3D Slicer keeps the space there.
    auto* const space =
        vtkStringArray::SafeDownCast(surface->GetFieldData()->GetAbstractArray(kSpaceArray));
    if (space != nullptr && space->GetNumberOfValues() > 0) {
      const std::string mark = "SPACE=" + std::string(space->GetValue(0));
      if (!FindSpaceMark(mark).empty()) document->comments.push_back(mark);
    }
  } catch (const std::exception& error) {
    return Damaged(path, error.what());
  }
  return Status::Ok();
}

Status EncodeVtk(const std::string& path, const PlyDocument& document, std::string* bytes) {
  const StatusOr<vtkSmartPointer<vtkPolyData>> surface = VtkFromDocument(path, document);
  if (!surface.ok()) return surface.status();
  const MessageScope messages;
  const bool is_xml = path.size() >= 4 && (path[path.size() - 1] | 0x20) == 'p';
  try {
    if (is_xml) {
      if (const std::string mark(SpaceMarkOf(document)); !mark.empty()) {
        const vtkNew<vtkStringArray> space;
        space->SetName(kSpaceArray);
        space->InsertNextValue(mark.substr(mark.find('=') + 1));
        (*surface)->GetFieldData()->AddArray(space);
      }
      const vtkNew<vtkXMLPolyDataWriter> writer;
      writer->SetInputData(*surface);
      writer->WriteToOutputStringOn();
      writer->Write();
      *bytes = writer->GetOutputString();
    } else {
      const vtkNew<vtkPolyDataWriter> writer;
      writer->SetInputData(*surface);
      const std::string title = "written by ceres_ed " + std::string(SpaceMarkOf(document));
      writer->SetHeader(title.c_str());
      writer->SetFileTypeToBinary();
      // Programs with a VTK before 9 read this version, too.
      writer->SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);
      writer->WriteToOutputStringOn();
      writer->Write();
      *bytes = writer->GetOutputStdString();
    }
  } catch (const std::exception& error) {
    return Status::Error(path + ": VTK cannot write it: " + error.what());
  }
  if (!messages.first().empty() || bytes->empty()) {
    return Status::Error(path + ": VTK cannot write it: " + messages.first());
  }
  return Status::Ok();
}

}  // namespace
}  // namespace ceres_ed

extern "C" [[gnu::visibility("default")]] const ceres_ed::MeshModule* ceres_ed_mesh_module() {
  static const ceres_ed::MeshModule module = {
      CERES_ED_VERSION_STRING, ceres_ed::ReadVtkFile, ceres_ed::EncodeVtk};
  return &module;
}
