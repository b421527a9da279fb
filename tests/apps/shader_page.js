// The end of a page of shader_test: runs `fragment` on two textures of side x side floats and
// shows "results:", the bits of r, g, b of every pixel in hexadecimal, and ";".
function run() {
  const canvas = document.createElement('canvas');
  const gl = canvas.getContext(version === 1 ? 'webgl' : 'webgl2');
  if (!gl) return 'no WebGL ' + version;
  const needed = version === 1 ? ['OES_texture_float', 'WEBGL_color_buffer_float']
                               : ['EXT_color_buffer_float'];
  for (const name of needed) if (!gl.getExtension(name)) return 'no ' + name;
  const format = version === 1 ? gl.RGBA : gl.RGBA32F;

  const texture = (unit, values) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    }
    const texels = values && new Float32Array(values);
    gl.texImage2D(gl.TEXTURE_2D, 0, format, side, side, 0, gl.RGBA, gl.FLOAT, texels);
    return gl.getParameter(gl.TEXTURE_BINDING_2D);
  };

  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return gl.getShaderInfoLog(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return gl.getProgramInfoLog(program);
  gl.useProgram(program);

  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture(2, null), 0);
  texture(0, lights);
  texture(1, reflectances);
  gl.uniform1i(gl.getUniformLocation(program, 'lights'), 0);
  gl.uniform1i(gl.getUniformLocation(program, 'reflectances'), 1);

  const at = gl.getAttribLocation(program, 'at');
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
  gl.enableVertexAttribArray(at);
  gl.vertexAttribPointer(at, 2, gl.FLOAT, false, 0, 0);
  gl.viewport(0, 0, side, side);
  gl.drawArrays(gl.TRIANGLES, 0, 3);

  const pixels = new Float32Array(4 * side * side);
  gl.readPixels(0, 0, side, side, gl.RGBA, gl.FLOAT, pixels);
  if (gl.getError() !== gl.NO_ERROR) return 'WebGL error';
  const bits = new Uint32Array(pixels.buffer);
  let text = 'results:';
  for (let k = 0; k < bits.length; k += 4) {
    for (let c = 0; c < 3; ++c) text += ' ' + bits[k + c].toString(16);
  }
  return text + ';';
}
document.getElementById('said').textContent = run();
