import com.android.apksig.ApkSigner;
import com.android.apksig.ApkVerifier;
import com.android.tools.r8.CompilationMode;
import com.android.tools.r8.D8;
import com.android.tools.r8.D8Command;
import com.android.tools.r8.JdkClassFileProvider;
import com.android.tools.r8.OutputMode;
import java.io.ByteArrayOutputStream;
import java.io.File;
import java.io.IOException;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.KeyStore;
import java.security.PrivateKey;
import java.security.cert.X509Certificate;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import java.util.zip.CRC32;
import java.util.zip.ZipEntry;
import java.util.zip.ZipFile;
import java.util.zip.ZipOutputStream;

/**
 * Puts an APK together: the classes as dex, the resources of aapt2, and whatever else the jars hold for the run time
 * (META-INF/services and resources); aligned and signed with the schemes v2 and v3. The result is verified before it
 * gets its name, and the same input gives the same bytes with the same key.
 *
 * <p>Run from its source, `java -cp (D8 and apksig) PackageApk.java`, by android-app/pom.xml.
 *
 * <p>Arguments: resources.apk, APK to write, minimum API level, android.jar, key store (PKCS12; made when it is not
 * there), class path of the program.
 */
final class PackageApk {
    /** What every debug key store of Android has. */
    private static final String PASSWORD = "android";
    private static final String ALIAS = "androiddebugkey";

    /** In jars, for compilers, shrinkers and people; no program reads it at run time. */
    private static final Pattern NOT_FOR_RUN_TIME = Pattern.compile(
        "META-INF/(MANIFEST\\.MF|[^/]*\\.(SF|DSA|RSA|EC|kotlin_module|version)|(maven|proguard|com\\.android\\.tools|versions)/.*"
            + "|kotlin-project-structure-metadata\\.json|(LICENSE|NOTICE|DEPENDENCIES|AL2\\.0|LGPL2\\.1)[^/]*)"
            + "|.*\\.(class|kotlin_builtins|kotlin_metadata|knm)|[A-Za-z]+Main/default/.*"
            + "|(.*/)?module-info.*|.*/");

    private static final String SERVICES = "META-INF/services/";

    public static void main(String[] arguments) throws Exception {
        Path resources = Path.of(arguments[0]);
        Path apk = Path.of(arguments[1]);
        int minimumApi = Integer.parseInt(arguments[2]);
        Path androidJar = Path.of(arguments[3]);
        Path keyStore = Path.of(arguments[4]);
        List<Path> program =
            Arrays.stream(arguments[5].split(File.pathSeparator)).map(Path::of).filter(Files::exists).toList();

        Path work = Files.createTempDirectory(apk.toAbsolutePath().getParent(), "apk");
        try {
            dex(program, androidJar, minimumApi, work);
            Path unsigned = work.resolve("unsigned.apk");
            write(resources, work, javaResources(program), unsigned);
            Path signed = work.resolve("signed.apk");
            sign(unsigned, signed, minimumApi, keyStore);
            verify(signed, minimumApi);
            Files.move(signed, apk, java.nio.file.StandardCopyOption.REPLACE_EXISTING);
        } finally {
            try (Stream<Path> left = Files.walk(work)) {
                left.sorted(java.util.Comparator.reverseOrder()).forEach(path -> path.toFile().delete());
            }
        }
        System.out.println(apk + ": " + Files.size(apk) + " bytes");
    }

    private static void dex(List<Path> program, Path androidJar, int minimumApi, Path output) throws Exception {
        List<Path> classes = new ArrayList<>();
        for (Path entry : program) {
            if (Files.isDirectory(entry)) {
                try (Stream<Path> files = Files.walk(entry)) {
                    files.filter(file -> file.toString().endsWith(".class")).sorted().forEach(classes::add);
                }
            } else {
                classes.add(entry);
            }
        }
        D8.run(
            D8Command.builder()
                .addProgramFiles(classes)
                .addLibraryFiles(androidJar)
                // android-all leaves out the classes of Java itself.
                .addLibraryResourceProvider(JdkClassFileProvider.fromSystemJdk())
                .setMinApiLevel(minimumApi)
                .setMode(CompilationMode.DEBUG)
                .setOutput(output, OutputMode.DexIndexed)
                .build());
    }

    /** By name. Service lists of several jars are joined; any other name may have one content only. */
    private static Map<String, byte[]> javaResources(List<Path> program) throws IOException {
        Map<String, byte[]> found = new TreeMap<>();
        for (Path entry : program) {
            if (Files.isDirectory(entry)) {
                try (Stream<Path> files = Files.walk(entry)) {
                    for (Path file : files.filter(Files::isRegularFile).toList()) {
                        String name = entry.relativize(file).toString().replace(File.separatorChar, '/');
                        put(found, name, Files.readAllBytes(file));
                    }
                }
            } else {
                try (ZipFile jar = new ZipFile(entry.toFile())) {
                    for (ZipEntry file : (Iterable<ZipEntry>) jar.stream().map(ZipEntry.class::cast)::iterator) {
                        put(found, file.getName(), bytes(jar, file));
                    }
                }
            }
        }
        return found;
    }

    private static void put(Map<String, byte[]> found, String name, byte[] content) throws IOException {
        if (NOT_FOR_RUN_TIME.matcher(name).matches()) return;
        byte[] before = found.get(name);
        if (before == null) {
            found.put(name, content);
        } else if (name.startsWith(SERVICES)) {
            ByteArrayOutputStream both = new ByteArrayOutputStream();
            both.write(before);
            both.write('\n');
            both.write(content);
            found.put(name, both.toByteArray());
        } else if (!Arrays.equals(before, content)) {
            throw new IOException("two jars have different contents for " + name);
        }
    }

    private static void write(Path resources, Path dexes, Map<String, byte[]> javaResources, Path apk) throws IOException {
        try (ZipOutputStream zip = new ZipOutputStream(Files.newOutputStream(apk)); ZipFile linked = new ZipFile(resources.toFile())) {
            for (ZipEntry entry : (Iterable<ZipEntry>) linked.stream().map(ZipEntry.class::cast)::iterator) {
                // From Android 11 on the resource table must not be compressed.
                boolean stored = entry.getMethod() == ZipEntry.STORED || entry.getName().equals("resources.arsc");
                add(zip, entry.getName(), bytes(linked, entry), stored);
            }
            try (Stream<Path> files = Files.list(dexes)) {
                for (Path dex : files.filter(file -> file.toString().endsWith(".dex")).sorted().toList()) {
                    add(zip, dex.getFileName().toString(), Files.readAllBytes(dex), false);
                }
            }
            for (Map.Entry<String, byte[]> file : javaResources.entrySet()) add(zip, file.getKey(), file.getValue(), false);
        }
    }

    private static void add(ZipOutputStream zip, String name, byte[] content, boolean stored) throws IOException {
        ZipEntry entry = new ZipEntry(name);
        entry.setTime(0);
        if (stored) {
            CRC32 checksum = new CRC32();
            checksum.update(content);
            entry.setMethod(ZipEntry.STORED);
            entry.setSize(content.length);
            entry.setCrc(checksum.getValue());
        }
        zip.putNextEntry(entry);
        zip.write(content);
        zip.closeEntry();
    }

    private static byte[] bytes(ZipFile zip, ZipEntry entry) throws IOException {
        try (InputStream content = zip.getInputStream(entry)) {
            return content.readAllBytes();
        }
    }

    private static void sign(Path unsigned, Path signed, int minimumApi, Path keyStore) throws Exception {
        if (Files.notExists(keyStore)) makeKey(keyStore);
        KeyStore store = KeyStore.getInstance("PKCS12");
        try (InputStream content = Files.newInputStream(keyStore)) {
            store.load(content, PASSWORD.toCharArray());
        }
        PrivateKey key = (PrivateKey) store.getKey(ALIAS, PASSWORD.toCharArray());
        X509Certificate certificate = (X509Certificate) store.getCertificate(ALIAS);
        ApkSigner.SignerConfig signer = new ApkSigner.SignerConfig.Builder("debug", key, List.of(certificate)).build();
        new ApkSigner.Builder(List.of(signer))
            .setInputApk(unsigned.toFile())
            .setOutputApk(signed.toFile())
            .setMinSdkVersion(minimumApi)
            .setV1SigningEnabled(false) // for Android 6 and older
            .setV2SigningEnabled(true)
            .setV3SigningEnabled(true)
            .setAlignFileSize(true)
            .build()
            .sign();
    }

    private static void makeKey(Path keyStore) throws Exception {
        List<String> command = List.of(
            Path.of(System.getProperty("java.home"), "bin", "keytool").toString(), "-genkeypair",
            "-keystore", keyStore.toString(), "-storetype", "PKCS12", "-storepass", PASSWORD, "-alias", ALIAS,
            "-keyalg", "RSA", "-keysize", "2048", "-validity", "10000", "-dname", "CN=Android Debug");
        Process keytool = new ProcessBuilder(command).redirectErrorStream(true).start();
        String said = new String(keytool.getInputStream().readAllBytes());
        if (keytool.waitFor() != 0) throw new IOException("keytool: " + said);
    }

    private static void verify(Path apk, int minimumApi) throws Exception {
        ApkVerifier.Result result =
            new ApkVerifier.Builder(apk.toFile()).setMinCheckedPlatformVersion(minimumApi).build().verify();
        boolean good = result.isVerified() && result.isVerifiedUsingV2Scheme() && result.isVerifiedUsingV3Scheme();
        if (!good) throw new IOException("the APK does not verify: " + result.getAllErrors());
    }
}
